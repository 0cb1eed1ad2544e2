// `lapwing`: what writers of scripts need; every other verb is handed over to the program that has it.
#include "apps/program.hpp"
#include "apps/verb.hpp"
#include "apps/verb_table.hpp"

int main(int argc, char** argv) {
  using namespace lapwing::apps;
  OwnVerb const own[] = {{"check", add_check}, {"fmt", add_fmt}, {"lsp", add_lsp}};
  return run_program(front_program, own, argc, argv);
}
