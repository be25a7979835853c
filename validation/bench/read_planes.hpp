// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace bench {

/// The half-space a·x + b·y + c·z <= d as a `.planes` file spells it; integers.
struct PlaneLine {
  std::array<std::string, 4> abcd;
  std::uint32_t level = 0;
};

/// The planes of a `.planes` file over Q with integer coefficients; peers share no code with hexact.
inline std::vector<PlaneLine> read_planes(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot open " + path);
  std::vector<PlaneLine> planes;
  std::size_t wanted = 0;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    if (wanted == 0) {
      std::string key;
      words >> key;
      if (key == "planes") words >> wanted;
      continue;
    }
    PlaneLine plane;
    for (std::string& number : plane.abcd) {
      words >> number;
      if (number.find_first_not_of("-0123456789") != std::string::npos) {
        throw std::runtime_error(path + ": the peers read integer planes only, not " + number);
      }
    }
    words >> plane.level;
    if (!words) throw std::runtime_error(path + ": a plane line is incomplete: " + line);
    planes.push_back(plane);
    if (planes.size() == wanted) return planes;
  }
  throw std::runtime_error(path + ": the list of planes is incomplete");
}

}  // namespace bench
