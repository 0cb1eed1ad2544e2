// `lapwing-map`: every verb that reads or writes pictures of maps and the files of GIS programs.
#include "apps/program.hpp"
#include "apps/verb.hpp"

int main(int argc, char** argv) {
  using namespace lapwing::apps;
  OwnVerb const own[] = {{"basemap", add_basemap}, {"explore", add_explore}, {"store", add_store}};
  return run_program("lapwing-map", own, argc, argv);
}
