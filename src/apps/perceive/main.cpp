// `lapwing-perceive`: what sees, maps and plans on a survey drone, and what shows simulated drones a car park.
#include "apps/program.hpp"
#include "apps/verb.hpp"

int main(int argc, char** argv) {
  using namespace lapwing::apps;
  OwnVerb const own[] = {{"perceive", add_perceive}, {"overlook", add_overlook}, {"shoot", add_shoot}};
  return run_program("lapwing-perceive", own, argc, argv);
}
