// `lapwing-vehicles`: every verb that talks to vehicles, simulates or shows them.
#include "apps/program.hpp"
#include "apps/verb.hpp"

int main(int argc, char** argv) {
  using namespace lapwing::apps;
  OwnVerb const own[] = {{"run", add_run},         {"demo", add_demo},    {"plan", add_plan},
                         {"mission", add_mission}, {"sim", add_sim},      {"replay", add_replay},
                         {"station", add_station}, {"param", add_param},  {"signing", add_signing},
                         {"route", add_route},     {"doctor", add_doctor}};
  return run_program("lapwing-vehicles", own, argc, argv);
}
