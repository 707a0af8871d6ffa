#include "methods.h"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include <pcl/common/point_tests.h>
#include <pcl/filters/project_inliers.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>
#include <pcl/segmentation/sac_segmentation.h>
#include <pcl/surface/convex_hull.h>

Parameters parameters_of(const std::string &method) {
  // Chosen for recall of panels, on 12 frames of seed 7 (on voxels and organized).
  const Parameters chain = {{"leaf_m", 0.0}, {"plane_m", 0.004},  {"room_m", 0.01},   {"room_share", 0.12},
                            {"gap_m", 0.01}, {"iterations", 500}, {"min_points", 500}};
  if (method == "classical")
    return chain;
  if (method == "voxels") {
    Parameters on_voxels = chain;
    on_voxels["leaf_m"] = 0.01;
    on_voxels["gap_m"] = 0.02;
    on_voxels["min_points"] = 20;
    return on_voxels;
  }
  if (method == "organized")
    return {{"depth_change_factor", 0.02}, {"smoothing_px", 10}, {"min_readings", 300},
            {"angle_rad", 0.12},           {"distance_m", 0.02}, {"curvature", 0.03}};
  throw std::invalid_argument(method + ": no such method");
}

namespace {

using pcl::Indices;
using pcl::IndicesPtr;

/// The points that the chain works on, and for each input point which of them stands for it.
struct Work {
  Cloud::Ptr points{new Cloud};
  Labels of_input;
};

Work all_readings(const Cloud &cloud) {
  Work work;
  work.of_input.assign(cloud.size(), -1);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (pcl::isFinite(cloud[i])) {
      work.of_input[i] = std::int32_t(work.points->size());
      work.points->push_back(cloud[i]);
    }
  }
  return work;
}

Work voxels(const Cloud::ConstPtr &cloud, float leaf_m) {
  Work work;
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setLeafSize(leaf_m, leaf_m, leaf_m);
  grid.setSaveLeafLayout(true);
  grid.setInputCloud(cloud);
  grid.filter(*work.points);
  work.of_input.assign(cloud->size(), -1);
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    if (pcl::isFinite((*cloud)[i]))
      work.of_input[i] = grid.getCentroidIndex((*cloud)[i]);
  }
  return work;
}

/// Takes the largest plane out of `left`; empty where it has fewer than `least` points, `left` then being as it was.
Indices take_plane(const Cloud::ConstPtr &points, IndicesPtr &left, double within_m, int iterations, std::size_t least,
                   pcl::ModelCoefficients &model) {
  if (left->size() < std::max<std::size_t>(least, 3))
    return {};
  pcl::SACSegmentation<pcl::PointXYZ> ransac;
  ransac.setModelType(pcl::SACMODEL_PLANE);
  ransac.setMethodType(pcl::SAC_RANSAC);
  ransac.setOptimizeCoefficients(true);
  ransac.setDistanceThreshold(within_m);
  ransac.setMaxIterations(iterations);
  ransac.setInputCloud(points);
  ransac.setIndices(left);
  pcl::PointIndices inliers;
  ransac.segment(inliers, model);
  if (inliers.indices.size() < least)
    return {};
  std::vector<bool> is_taken(points->size(), false);
  for (const auto i : inliers.indices)
    is_taken[std::size_t(i)] = true;
  IndicesPtr rest(new Indices);
  for (const auto i : *left)
    if (!is_taken[std::size_t(i)])
      rest->push_back(i);
  left = rest;
  return inliers.indices;
}

/// What the chain is for; its result is not scored, but its time counts.
void hull_of(const Cloud::ConstPtr &points, const Indices &plane, const pcl::ModelCoefficients &model) {
  Cloud::Ptr flat(new Cloud);
  pcl::ProjectInliers<pcl::PointXYZ> projection;
  projection.setModelType(pcl::SACMODEL_PLANE);
  projection.setInputCloud(points);
  projection.setIndices(IndicesPtr(new Indices(plane)));
  projection.setModelCoefficients(pcl::ModelCoefficients::ConstPtr(new pcl::ModelCoefficients(model)));
  projection.filter(*flat);
  Cloud corners;
  pcl::ConvexHull<pcl::PointXYZ> hull;
  hull.setInputCloud(flat);
  hull.setDimension(2);
  hull.reconstruct(corners);
}

} // namespace

Labels classical(const Cloud::ConstPtr &cloud, const Parameters &parameters) {
  const auto leaf_m = float(parameters.at("leaf_m"));
  const auto iterations = int(parameters.at("iterations"));
  const auto least = std::size_t(parameters.at("min_points"));
  const Work work = leaf_m > 0 ? voxels(cloud, leaf_m) : all_readings(*cloud);
  Labels planes(work.points->size(), -1);
  std::int32_t count = 0;
  const auto mark = [&](const Indices &plane) {
    for (const auto i : plane)
      planes[std::size_t(i)] = count;
    ++count;
  };

  IndicesPtr left(new Indices(work.points->size()));
  std::iota(left->begin(), left->end(), 0);
  const auto room_points = std::size_t(parameters.at("room_share") * double(left->size()));
  pcl::ModelCoefficients model;
  for (Indices plane; !(plane = take_plane(work.points, left, parameters.at("room_m"), iterations, room_points, model)).empty();)
    mark(plane);

  pcl::search::KdTree<pcl::PointXYZ>::Ptr tree(new pcl::search::KdTree<pcl::PointXYZ>);
  tree->setInputCloud(work.points, left);
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setClusterTolerance(parameters.at("gap_m"));
  extraction.setMinClusterSize(pcl::uindex_t(least));
  extraction.setSearchMethod(tree);
  extraction.setInputCloud(work.points);
  extraction.setIndices(left);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);

  for (const auto &cluster : clusters) {
    IndicesPtr in_cluster(new Indices(cluster.indices));
    for (Indices plane; !(plane = take_plane(work.points, in_cluster, parameters.at("plane_m"), iterations, least, model)).empty();) {
      mark(plane);
      hull_of(work.points, plane, model);
    }
  }

  Labels labels(cloud->size(), -1);
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (work.of_input[i] >= 0)
      labels[i] = planes[std::size_t(work.of_input[i])];
  return labels;
}
