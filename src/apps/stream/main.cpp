// `lapwing-stream`: a survey drone's pictures for players of video.
#include "apps/program.hpp"
#include "apps/verb.hpp"

int main(int argc, char** argv) {
  using namespace lapwing::apps;
  OwnVerb const own[] = {{"stream", add_stream}};
  return run_program("lapwing-stream", own, argc, argv);
}
