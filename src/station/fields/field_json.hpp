#pragma once

#include <functional>
#include <string>
#include <vector>

#include "station/fields/field_visitor.hpp"
#include "station/messages/feed_json.hpp"

namespace lapwing::station::internal {

/// Writes lines of a table into a JSON object, and the ages of those that have one into its `age_s`.
class FieldJson : public FieldVisitor {
 public:
  /// Which lines, by key; without a function all of them. The age of a line alone is told when its value is not news.
  struct News {
    bool value = true;
    bool age = true;
  };
  using Choose = std::function<News(std::string_view key)>;

  FieldJson(Json& into, base::TimePoint now, Choose choose = {});
  /// Writes the ages; call it last.
  void finish();

  bool wants(Member const& member) override;
  void number(Member const& member, std::optional<double> value, Unit const& unit) override;
  void flag(Member const& member, bool value) override;
  void text(Member const& member, std::string_view value) override;
  void word(Member const& member, std::string_view value, Words const& words) override;
  void begin_object(Member const& member, Type const& type) override;
  void begin_list(Member const& member, Unique unique) override;
  void end() override;

 private:
  Json& put(Member const& member, Json value);

  base::TimePoint now_;
  Choose choose_;
  Json ages_ = Json::object();
  std::vector<Json*> open_;  ///< the innermost last; nothing else is added to the others meanwhile
};

}  // namespace lapwing::station::internal
