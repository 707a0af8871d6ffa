#include "methods.h"

#include <pcl/features/integral_image_normal.h>
#include <pcl/segmentation/organized_multi_plane_segmentation.h>

Labels organized(const Cloud::ConstPtr &cloud, const Parameters &parameters) {
  pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  pcl::IntegralImageNormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setNormalEstimationMethod(estimation.COVARIANCE_MATRIX);
  estimation.setMaxDepthChangeFactor(float(parameters.at("depth_change_factor")));
  estimation.setNormalSmoothingSize(float(parameters.at("smoothing_px")));
  estimation.setInputCloud(cloud);
  estimation.compute(*normals);

  pcl::OrganizedMultiPlaneSegmentation<pcl::PointXYZ, pcl::Normal, pcl::Label> segmentation;
  segmentation.setMinInliers(unsigned(parameters.at("min_readings")));
  segmentation.setAngularThreshold(parameters.at("angle_rad"));
  segmentation.setDistanceThreshold(parameters.at("distance_m"));
  segmentation.setMaximumCurvature(parameters.at("curvature"));
  segmentation.setInputCloud(cloud);
  segmentation.setInputNormals(normals);
  std::vector<pcl::PlanarRegion<pcl::PointXYZ>, Eigen::aligned_allocator<pcl::PlanarRegion<pcl::PointXYZ>>> regions;
  std::vector<pcl::ModelCoefficients> models;
  std::vector<pcl::PointIndices> inliers, label_indices, boundaries;
  pcl::PointCloud<pcl::Label>::Ptr pixels(new pcl::PointCloud<pcl::Label>);
  segmentation.segmentAndRefine(regions, models, inliers, pixels, label_indices, boundaries);

  Labels labels(cloud->size(), -1);
  for (std::size_t plane = 0; plane < inliers.size(); ++plane)
    for (const auto i : inliers[plane].indices)
      labels[std::size_t(i)] = std::int32_t(plane);
  return labels;
}
