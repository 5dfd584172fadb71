/// A hundred controllers: one leading axis, 99 proxies on as many controllers, four cascades deep.
#pragma once

#include <string>
#include <vector>

#include "three_controllers.hpp"

namespace lockstep::test {

/// C0 leads; C1 to C99 follow, by turns in the first, second, third and fourth cascade. The delays are 0, as
/// yet.
inline SystemFiles hundred_controllers() {
  constexpr int kDeep = 4;
  SystemFiles files;
  files.add("C0", leading(0.0));
  std::vector<std::vector<std::string>> levels(kDeep);
  for (int i = 1; i < 100; ++i) {
    const int level = (i - 1) % kDeep;
    const bool provides = i <= kDeep && level + 1 < kDeep;  // the first one of each level leads the next one
    ControllerFile file("follower");
    file.proxy("Line");
    file.axis("Far", kRing);
    file.gear("Far", "Line", 1, 1, provides ? "delayed" : "setpoint");
    if (provides) {
      file.axis("Virtual", kRing);
      file.provide("Virtual", 0.0);
      file.gear("Virtual", "Line");
    }
    give_limits(file);
    const std::string name = "C" + std::to_string(i);
    files.add(name, file);
    levels[static_cast<std::size_t>(level)].push_back(name + ".Line");
  }
  for (int level = 0; level < kDeep; ++level)
    files.area("level" + std::to_string(level),
               level == 0 ? "C0.Leader" : "C" + std::to_string(level) + ".Virtual",
               levels[static_cast<std::size_t>(level)]);
  return files;
}

}  // namespace lockstep::test
