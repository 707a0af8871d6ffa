// Frames as raw float32 x, y, z (NaN where there is no reading) and labels as raw int32, in the machine's byte order.
#pragma once

#include <string>

#include "methods.h"

/// Throws std::runtime_error where the file does not hold width * height points.
Cloud::Ptr read_frame(const std::string &path, std::uint32_t width, std::uint32_t height);

void write_labels(const std::string &path, const Labels &labels);
