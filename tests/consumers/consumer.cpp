// The ten lines of the README: load a project, step it in virtual time, read a signal.
#include <cstdio>

#include "projects/loader/simulation.hpp"

int main(int /*argc*/, char** argv) {
  lockstep::Simulation machine(argv[1]);
  machine.run_for(std::chrono::seconds(5));
  std::printf("Knife.Position %.3f\n", machine.read("Knife.Position"));
  return machine.read("Knife.StatusWord.X22") == 1.0 ? 0 : 1;
}
