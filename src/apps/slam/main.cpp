// `lapwing-slam`: maps made from what robots recorded.
#include "apps/program.hpp"
#include "apps/verb.hpp"

int main(int argc, char** argv) {
  using namespace lapwing::apps;
  OwnVerb const own[] = {{"map", add_map}};
  return run_program("lapwing-slam", own, argc, argv);
}
