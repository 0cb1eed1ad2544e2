// `lapwing-perceive`: what sees, maps and plans on a survey drone.
#include "apps/program.hpp"
#include "apps/verb.hpp"

int main(int argc, char** argv) {
  using namespace lapwing::apps;
  OwnVerb const own[] = {{"perceive", add_perceive}};
  return run_program("lapwing-perceive", own, argc, argv);
}
