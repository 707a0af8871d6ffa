// pcl_planes METHOD WIDTH HEIGHT REPEATS OUT [NAME=VALUE...] FRAME...
//
// METHOD is classical, voxels or organized. Each FRAME.f32 is loaded once and segmented REPEATS times; OUT/FRAME.i32
// gets the labels, standard output a line of JSON with the CPU milliseconds of each repeat. NAME=VALUE replaces a
// parameter. One thread: PCL's classes used here have no other.
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <stdexcept>

#include <pcl/console/print.h>

#include "frames.h"

namespace fs = std::filesystem;

namespace {

double cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * double(now.tv_sec) + 1e-6 * double(now.tv_nsec);
}

Labels run(const std::string &method, const Cloud::ConstPtr &cloud, const Parameters &parameters) {
  return method == "organized" ? organized(cloud, parameters) : classical(cloud, parameters);
}

void measure(const std::string &method, const Parameters &parameters, const fs::path &path, const fs::path &out,
             const std::uint32_t size[2], int repeats) {
  const Cloud::ConstPtr cloud = read_frame(path.string(), size[0], size[1]);
  std::printf("{\"frame\": \"%s\", \"cpu_ms\": [", path.stem().c_str());
  Labels labels;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const double start = cpu_ms();
    labels = run(method, cloud, parameters);
    std::printf("%s%.4f", repeat ? ", " : "", cpu_ms() - start);
  }
  std::printf("]}\n");
  std::fflush(stdout);
  write_labels((out / path.stem()).string() + ".i32", labels);
}

void replace(Parameters &parameters, const std::string &text) {
  const std::size_t equals = text.find('=');
  const auto found = parameters.find(text.substr(0, equals));
  if (found == parameters.end())
    throw std::invalid_argument(text + ": no such parameter");
  found->second = std::stod(text.substr(equals + 1));
}

} // namespace

int main(int count, char **arguments) try {
  if (count < 7) {
    std::fprintf(stderr, "usage: pcl_planes METHOD WIDTH HEIGHT REPEATS OUT [NAME=VALUE...] FRAME...\n");
    return 2;
  }
  pcl::console::setVerbosityLevel(pcl::console::L_ERROR);
  const std::string method = arguments[1];
  const std::uint32_t size[2] = {std::uint32_t(std::stoul(arguments[2])), std::uint32_t(std::stoul(arguments[3]))};
  Parameters parameters = parameters_of(method);
  for (int i = 6; i < count; ++i) {
    const std::string argument = arguments[i];
    if (argument.find('=') != std::string::npos)
      replace(parameters, argument);
    else
      measure(method, parameters, argument, arguments[5], size, std::stoi(arguments[4]));
  }
  return 0;
} catch (const std::exception &error) {
  std::fprintf(stderr, "pcl_planes: %s\n", error.what());
  return 1;
}
