// `lapwing-onboard`: what runs on a vehicle.
#include "apps/program.hpp"
#include "apps/verb.hpp"

int main(int argc, char** argv) {
  using namespace lapwing::apps;
  OwnVerb const own[] = {{"onboard", add_onboard}};
  return run_program("lapwing-onboard", own, argc, argv);
}
