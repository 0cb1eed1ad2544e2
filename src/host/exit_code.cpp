#include "host/exit_code.hpp"

#include <fmt/format.h>

namespace lapwing::host {

void print_error(base::Error const& error) {
  fmt::print(stderr, "lapwing: {}\n", error.message);
  if (!error.hint.empty()) fmt::print(stderr, "         {}\n", error.hint);
}

int refuse(base::Error const& error) {
  print_error(error);
  bool const is_usage = error.kind == base::ErrorKind::invalid_input || error.kind == base::ErrorKind::not_found;
  return is_usage ? exit_usage : exit_halted;
}

}  // namespace lapwing::host
