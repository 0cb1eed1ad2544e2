#include "dolphin/value/regular_expression.hpp"

#include <cctype>
#include <utility>

#include <re2/re2.h>

namespace lapwing::dolphin {

namespace {

re2::StringPiece piece(std::string_view text) {
  return {text.data(), text.size()};
}

/// Java writes named groups as `(?<name>x)`, RE2 as `(?P<name>x)`.
std::string in_words_of_re2(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size(); ++at) {
    out += text[at];
    if (text[at] == '\\' && at + 1 < text.size()) {
      out += text[++at];
      continue;
    }
    bool const is_named = text.substr(at).starts_with("(?<") && at + 3 < text.size() &&
                          std::isalpha(static_cast<unsigned char>(text[at + 3]));
    if (!is_named) continue;
    out += "?P";
    ++at;
  }
  return out;
}

}  // namespace

RegularExpression::RegularExpression(std::string text, std::unique_ptr<re2::RE2> machine)
    : text_(std::move(text)), machine_(std::move(machine)) {}

RegularExpression::~RegularExpression() = default;

std::expected<std::shared_ptr<RegularExpression const>, std::string> RegularExpression::make(std::string text) {
  re2::RE2::Options options;
  options.set_log_errors(false);
  options.set_max_mem(static_cast<std::int64_t>(most_bytes));
  auto machine = std::make_unique<re2::RE2>(piece(in_words_of_re2(text)), options);
  if (!machine->ok()) {
    bool const looks_around = machine->error_code() == re2::RE2::ErrorBadPerlOp;
    bool const refers_back = machine->error_code() == re2::RE2::ErrorBadEscape;
    auto const* reason = looks_around  ? " (there is no look-ahead and no look-behind)"
                         : refers_back ? " (there are no back references)"
                                       : "";
    return std::unexpected(machine->error() + reason);
  }
  return std::shared_ptr<RegularExpression const>(new RegularExpression(std::move(text), std::move(machine)));
}

std::size_t RegularExpression::groups() const {
  return static_cast<std::size_t>(machine_->NumberOfCapturingGroups());
}

bool RegularExpression::matches(std::string_view text) const {
  return machine_->Match(piece(text), 0, text.size(), re2::RE2::ANCHOR_BOTH, nullptr, 0);
}

bool RegularExpression::occurs_in(std::string_view text) const {
  return machine_->Match(piece(text), 0, text.size(), re2::RE2::UNANCHORED, nullptr, 0);
}

std::optional<RegularExpression::Match> RegularExpression::find(std::string_view text, std::size_t from) const {
  std::vector<re2::StringPiece> found(groups() + 1);
  auto const count = static_cast<int>(found.size());
  if (!machine_->Match(piece(text), from, text.size(), re2::RE2::UNANCHORED, found.data(), count)) return std::nullopt;
  Match out{static_cast<std::size_t>(found[0].data() - text.data()), 0, {}};
  out.end = out.begin + found[0].size();
  for (auto const& one : found) {
    out.groups.push_back(one.data() ? std::optional(std::string_view(one.data(), one.size())) : std::nullopt);
  }
  return out;
}

}  // namespace lapwing::dolphin
