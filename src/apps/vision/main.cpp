// `lapwing-vision`: every verb that looks at pictures.
#include "apps/program.hpp"
#include "apps/verb.hpp"

int main(int argc, char** argv) {
  using namespace lapwing::apps;
  OwnVerb const own[] = {{"detect", add_detect}};
  return run_program("lapwing-vision", own, argc, argv);
}
