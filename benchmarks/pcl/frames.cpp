#include "frames.h"

#include <fstream>
#include <stdexcept>

Cloud::Ptr read_frame(const std::string &path, std::uint32_t width, std::uint32_t height) {
  std::vector<float> raw(std::size_t(3) * width * height);
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char *>(raw.data()), std::streamsize(raw.size() * sizeof(float)));
  if (!file || file.peek() != std::ifstream::traits_type::eof())
    throw std::runtime_error(path + ": does not hold " + std::to_string(std::size_t(width) * height) + " points");
  Cloud::Ptr cloud(new Cloud(width, height));
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    cloud->points[i] = pcl::PointXYZ(raw[3 * i], raw[3 * i + 1], raw[3 * i + 2]);
  }
  cloud->is_dense = false;
  return cloud;
}

void write_labels(const std::string &path, const Labels &labels) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char *>(labels.data()), std::streamsize(labels.size() * sizeof(Labels::value_type)));
  if (!file)
    throw std::runtime_error(path + ": cannot be written");
}
