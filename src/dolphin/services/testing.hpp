#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "dolphin/services/document.hpp"
#include "missions/vocabulary.hpp"

/// What the tests of the language services need: a script with a place marked by `|`.
namespace lapwing::dolphin::testing {

class Marked {
 public:
  explicit Marked(std::string const& script) {
    auto const mark = script.find('|');
    auto const end = mark == std::string::npos ? script.size() : mark;
    offset = static_cast<std::uint32_t>(end);
    auto const text = script.substr(0, end) + (mark == std::string::npos ? "" : script.substr(mark + 1));
    document = std::make_unique<Document>("test.dolphin", text, vocabulary);
  }

  /// The words at the places.
  [[nodiscard]] std::vector<std::string> texts(std::vector<base::Span> const& places) const {
    std::vector<std::string> out;
    for (auto const one : places) out.emplace_back(document->text(one));
    return out;
  }

  tasks::Vocabulary added = missions::vocabulary();
  Vocabulary vocabulary{added};
  std::unique_ptr<Document> document;
  std::uint32_t offset = 0;
};

}  // namespace lapwing::dolphin::testing
