#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/error.hpp"

/// For .cpp files; no header includes this one.
namespace lapwing::station::internal {

/// A client's message or body, parsed once. Members are asked for one after the other, without a look at each answer:
/// what is missing or wrong gives the fallback, and the first thing that is wrong is the error of the whole request.
class RequestReader {
 public:
  /// Sorted by key: adding to objects that keep their order takes time that grows with the square of their size.
  using Json = nlohmann::json;

  explicit RequestReader(std::string_view text);

  /// Null where there is none.
  [[nodiscard]] Json const* find(char const* key) const;
  [[nodiscard]] std::string text(char const* key, std::string fallback = {});
  /// Finite, or nothing where there is none.
  [[nodiscard]] std::optional<double> number(char const* key);
  [[nodiscard]] bool flag(char const* key);
  /// Who asks, by a name that cannot be taken for the script and fits a line; empty when the client does not say.
  [[nodiscard]] std::string operator_name();
  /// At most so many texts, none longer than so much; `must` says what is wrong otherwise.
  [[nodiscard]] std::vector<std::string> texts(char const* key, std::size_t most, std::size_t longest,
                                               char const* must);
  [[nodiscard]] std::vector<std::uint64_t> naturals(char const* key, std::size_t most, char const* must);

  /// Notes what is wrong, unless something was before. The hint names the page that describes requests.
  void refuse(std::string message);
  /// What was read, when nothing was wrong.
  template <class Value>
  [[nodiscard]] base::Result<Value> result(Value value) const {
    if (error_) return std::unexpected(*error_);
    return value;
  }

 private:
  /// Null, after a refusal, when it is no list of at most so many.
  [[nodiscard]] Json const* list(char const* key, std::size_t most, char const* must);

  Json object_ = Json::object();
  std::optional<base::Error> error_;
};

}  // namespace lapwing::station::internal
