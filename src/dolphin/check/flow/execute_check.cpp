#include "dolphin/check/flow/internal/execute_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>

#include "dolphin/syntax/codes.hpp"

namespace lapwing::dolphin {

namespace {

/// A task that runs beside the others, and the vehicles it is limited to.
struct Demand {
  ast::Expr const* task;
  std::size_t vehicles;
  VehicleSet const* from = nullptr;  ///< null: any, or not known
  std::string name = {};             ///< of the variable that holds them
  base::Span place = {};             ///< of that name
};

class ExecuteCheck {
 public:
  explicit ExecuteCheck(ExecuteContext context)
      : resolution_(context.resolution),
        tasks_(context.tasks),
        state_(context.state),
        diagnostics_(context.diagnostics) {}

  void run(ast::Call const& execute) {
    if (has_duplicate_keys(execute)) return;
    for (auto const& argument : execute.arguments) {
      Demand limit{argument.value.get(), 0};
      if (argument.name && argument.name->text != "_") {
        limit.name = argument.name->text;
        limit.place = argument.name->span;
        limit.from = state_.find(resolution_.find(*argument.name));
      }
      collect(*argument.value, limit);
    }
    for (auto const& demand : demands_) {
      if (demand.from && (is_released(demand) || is_too_few(demand))) return;
      if (is_unsuited(demand)) return;
    }
    bool const is_clear =
        std::ranges::none_of(demands_, [](Demand const& one) { return !one.from && !one.name.empty(); });
    if (!is_shared() && is_clear) are_too_many();
  }

 private:
  [[nodiscard]] static bool has_duplicate_keys(ast::Call const& execute) {
    std::unordered_set<std::string_view> seen;
    return std::ranges::any_of(execute.arguments, [&](ast::Argument const& argument) {
      return argument.name && !seen.insert(argument.name->text).second;
    });
  }

  void collect(ast::Expr const& task, Demand limit) {
    auto const* binary = std::get_if<ast::Binary>(&task.node);
    if (binary && binary->op == ast::BinaryOp::bit_or) {
      collect(*binary->left, limit);
      return collect(*binary->right, std::move(limit));
    }
    if (auto const* index = std::get_if<ast::Index>(&task.node);
        index && std::holds_alternative<ast::Name>(index->index->node)) {
      limit.name = std::get<ast::Name>(index->index->node).text;
      limit.place = index->index->span;
      limit.from = state_.find(resolution_.find(*index->index));
      return collect(*index->object, std::move(limit));
    }
    limit.task = &task;
    limit.vehicles = tasks_.of(task).vehicles;
    if (limit.vehicles > 0) demands_.push_back(std::move(limit));
  }

  [[nodiscard]] std::string text(ast::Expr const& expr) const {
    auto const words = diagnostics_.source().text(expr.span);
    auto const line = words.substr(0, words.find_first_of("\r\n"));
    return line.size() == words.size() && line.size() <= 40 ? std::string(line) : "this task";
  }

  bool is_released(Demand const& demand) {
    auto worst = ReleaseFact{Released::yes, {}, 0};
    for (auto const pick : demand.from->picks) {
      auto const fact = state_.release_of(pick);
      worst.is = std::min(worst.is, fact.is);
      worst.place = fact.place;
    }
    if (worst.is == Released::no || demand.from->picks.empty()) return false;
    bool const is_certain = worst.is == Released::yes;
    auto const& task = tasks_.taker(*demand.task, 0);
    auto message = is_certain ? fmt::format("{} cannot run on {}: its vehicles are released", text(task), demand.name)
                              : fmt::format("the vehicles of {} may be released here", demand.name);
    diagnostics_.report(is_certain ? code("used-after-release") : code("maybe-released"), demand.place,
                        std::move(message), fmt::format("release {} later, or pick again", demand.name),
                        {{worst.place, "released here"}});
    return true;
  }

  bool is_too_few(Demand const& demand) {
    if (!demand.from->most || demand.vehicles <= *demand.from->most) return false;
    auto const& task = tasks_.taker(*demand.task, *demand.from->most);
    diagnostics_.report(
        code("too-few-vehicles"), task.span,
        fmt::format("{} cannot be allocated: {} has {}", text(task), demand.name, counted(*demand.from->most)),
        "run tasks one after the other with >>, or pick more vehicles", picked_here(*demand.from));
    return true;
  }

  /// Whether no vehicle that can be meant, as they were asked for, can do what one of the task's blocks says.
  bool is_unsuited(Demand const& demand) {
    auto const picks = candidates(demand);
    for (auto const* block : tasks_.blocks(*demand.task)) {
      auto const built = tasks_.built(*block);
      auto const misfit = built ? misfit_of(*built, picks) : std::nullopt;
      // Which of the vehicles that any task may have carries what is found out when they are allocated.
      if (!misfit || (!demand.from && !misfit->is_certain)) continue;
      report_unsuited(demand, *block, built->kind(), *misfit);
      return true;
    }
    return false;
  }

  /// The picks that its vehicles can come from; none when they are not known.
  [[nodiscard]] std::vector<Pick const*> candidates(Demand const& demand) const {
    std::vector<Pick const*> out;
    if (demand.from) {
      for (auto const pick : demand.from->picks) out.push_back(&state_.pick(pick));
    } else if (demand.name.empty() && state_.most_picked()) {
      for (auto const& pick : state_.picks()) out.push_back(&pick);
    }
    return out;
  }

  struct Misfit {
    Pick const* pick;
    std::string reason;
    bool is_certain;  ///< by its type; vehicles may carry more than was asked for
  };

  [[nodiscard]] static std::optional<Misfit> misfit_of(tasks::PlatformTask const& task, Pick const& pick) {
    tasks::VehicleInfo vehicle;
    vehicle.type = pick.type;
    auto reason = pick.type.empty() ? std::nullopt : task.unsuited(vehicle);
    if (reason) return Misfit{&pick, std::move(*reason), true};
    if (pick.payload.empty()) return std::nullopt;
    vehicle.payload = pick.payload;
    reason = task.unsuited(vehicle);
    return reason ? std::optional(Misfit{&pick, std::move(*reason), false}) : std::nullopt;
  }

  /// The least certain of all; nothing when one of the picks suits.
  [[nodiscard]] static std::optional<Misfit> misfit_of(tasks::PlatformTask const& task,
                                                       std::vector<Pick const*> const& picks) {
    std::optional<Misfit> out;
    for (auto const* pick : picks) {
      auto misfit = misfit_of(task, *pick);
      if (!misfit) return std::nullopt;
      if (!out || (out->is_certain && !misfit->is_certain)) out = std::move(misfit);
    }
    return out;
  }

  void report_unsuited(Demand const& demand, ast::Expr const& block, std::string_view kind, Misfit const& misfit) {
    auto const who =
        demand.from ? fmt::format("{} does not suit", demand.name) : std::string("no vehicle that is picked suits");
    diagnostics_.report(
        misfit.is_certain ? code("unsuited-vehicle") : code("missing-payload"),
        demand.from ? demand.place : demand.task->span, fmt::format("{} this {}: {}", who, kind, misfit.reason),
        misfit.is_certain ? "pick another type, or leave out what it cannot do" : "ask for it in pick",
        {{misfit.pick->place, "picked here"}, {std::get<ast::Call>(block.node).callee->span, "made here"}});
  }

  /// Two parts that have the same vehicles, and not enough of them.
  bool is_shared() {
    for (std::size_t i = 1; i < demands_.size(); ++i) {
      if (!demands_[i].from) continue;
      std::size_t needed = demands_[i].vehicles;
      Demand const* first = nullptr;
      for (auto const& one : std::span(demands_).first(i)) {
        if (!one.from || one.from->picks != demands_[i].from->picks) continue;
        first = first ? first : &one;
        needed += one.vehicles;
      }
      auto const there = counted(*demands_[i].from);
      if (!first || !there || needed <= *there) continue;
      report_shared(*first, demands_[i], *there);
      return true;
    }
    return false;
  }

  [[nodiscard]] std::optional<std::size_t> counted(VehicleSet const& set) const {
    std::size_t out = 0;
    for (auto const pick : set.picks) {
      auto const count = state_.pick(pick).count;
      if (!count) return std::nullopt;
      out += *count;
    }
    return out;
  }

  void report_shared(Demand const& earlier, Demand const& later, std::size_t there) {
    auto const& task = tasks_.taker(*later.task, later.vehicles - 1);
    if (earlier.name == later.name) {
      diagnostics_.report(code("too-few-vehicles"), task.span,
                          fmt::format("{} cannot be allocated: {} has {}", text(task), later.name, counted(there)),
                          "run tasks one after the other with >>, or pick more vehicles", picked_here(*later.from));
      return;
    }
    diagnostics_.report(code("vehicle-used-twice"), later.place,
                        fmt::format("{} cannot be allocated: {} and {} are the same {}", text(task), earlier.name,
                                    later.name, there == 1 ? "vehicle" : counted(there)),
                        "run tasks one after the other with >>", {{earlier.place, "taken here already"}});
  }

  /// Of all picks, when they are known: no other vehicle can be meant.
  template <class Test>
  [[nodiscard]] bool all_picked(Test test) const {
    if (state_.most_picked().value_or(0) == 0) return false;
    for (PickIndex pick = 0; pick < state_.picks().size(); ++pick) {
      if (!test(pick)) return false;
    }
    return true;
  }

  void are_too_many() {
    std::size_t needed = 0;
    for (auto const& demand : demands_) needed += demand.vehicles;
    auto const there = state_.most_picked();
    auto const is_released = [&](PickIndex pick) { return state_.release_of(pick).is == Released::yes; };
    if (needed > 0 && all_picked(is_released)) {
      auto const& task = tasks_.taker(*demands_.front().task, 0);
      diagnostics_.report(code("no-vehicle"), task.span,
                          fmt::format("{} needs a vehicle, and all are released", text(task)), "pick one again",
                          {{state_.release_of(0).place, "released here"}});
      return;
    }
    if (!there || needed <= *there) return;
    std::size_t others = *there;
    auto const short_of = std::ranges::find_if(demands_, [&](Demand const& demand) {
      if (demand.vehicles > others) return true;
      others -= demand.vehicles;
      return false;
    });
    report_too_many(tasks_.taker(*short_of->task, others), *there);
  }

  void report_too_many(ast::Expr const& task, std::size_t there) {
    if (there > 0) {
      diagnostics_.report(code("too-few-vehicles"), task.span,
                          fmt::format("{} cannot be allocated: {} picked", text(task),
                                      there == 1 ? "one vehicle is" : fmt::format("{} vehicles are", there)),
                          "pick more vehicles, or run tasks one after the other with >>");
    } else if (!diagnostics_.has_errors()) {  // a mistake may have hidden the pick
      diagnostics_.report(code("no-vehicle"), task.span,
                          fmt::format("{} needs a vehicle, and none is picked before", text(task)),
                          "pick one: v = pick { }");
    }
  }

  [[nodiscard]] static std::string counted(std::size_t count) {
    return count == 1 ? "one vehicle" : fmt::format("{} vehicles", count);
  }
  [[nodiscard]] std::vector<base::DiagnosticNote> picked_here(VehicleSet const& set) const {
    return {{state_.pick(set.picks.front()).place, "picked here"}};
  }

  Resolution const& resolution_;
  TaskShapes& tasks_;
  VehicleState const& state_;
  base::Diagnostics& diagnostics_;
  std::vector<Demand> demands_;
};

}  // namespace

void check_execute(ExecuteContext context, ast::Call const& execute) {
  ExecuteCheck(context).run(execute);
}

}  // namespace lapwing::dolphin
