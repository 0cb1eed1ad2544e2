// `lapwing-vision`: every verb that looks at pictures.
#include <unistd.h>

#include <cstdlib>

#include "apps/program.hpp"
#include "apps/verb.hpp"

int main(int argc, char** argv) {
  using namespace lapwing::apps;
  // Tesseract starts four threads for lines that take one 20 ms, and on a busy machine they wait for each other for
  // seconds. OpenMP reads its limit when the program is loaded: so it is loaded again, which costs a millisecond.
  if (std::getenv("OMP_THREAD_LIMIT") == nullptr && setenv("OMP_THREAD_LIMIT", "1", 1) == 0)
    execv("/proc/self/exe", argv);  // NOLINT(clang-analyzer-optin.taint.GenericTaint): with the words that it has
  OwnVerb const own[] = {{"detect", add_detect}, {"look", add_look}};
  return run_program("lapwing-vision", own, argc, argv);
}
