// The ways from a cloud to a plane's number for each point, -1 for none.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Labels = std::vector<std::int32_t>;
using Parameters = std::map<std::string, double>;

/// The parameters of a method; throws std::invalid_argument where it does not exist.
Parameters parameters_of(const std::string &method);

/// Ground by RANSAC, Euclidean clusters, planes by RANSAC in each, their hulls; on voxels where leaf_m is not 0.
Labels classical(const Cloud::ConstPtr &cloud, const Parameters &parameters);

/// Normals by integral images, then organized multi-plane segmentation, refined.
Labels organized(const Cloud::ConstPtr &cloud, const Parameters &parameters);
