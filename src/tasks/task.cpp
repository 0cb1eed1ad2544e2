#include "tasks/task.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace lapwing::tasks {
namespace {

template <class... Fs>
struct Overloaded : Fs... {
  using Fs::operator()...;
};

constexpr std::size_t large_bytes = 16'384;

/// Sums stay countable: a task of thirty doublings has more parts than an int can say.
int sum(int a, int b) {
  return std::min(a, too_large - b) + b;
}

void count_child(TaskNode& node, TaskTree const& child) {
  node.depth = std::max(node.depth, child->depth + 1);
  node.size = sum(node.size, child->size);
  node.performed = sum(node.performed, child->performed);
  node.bytes += child->bytes > large_bytes ? 0 : child->bytes;
  node.is_restricted = node.is_restricted || child->is_restricted;
}

/// A survey of a thousand legs that is flown a thousand times is there once.
void count_large(TaskNode& node, std::vector<TaskTree> const& parts) {
  std::vector<TaskNode const*> large;
  for (auto const& part : parts) {
    if (part->bytes > large_bytes) large.push_back(part.get());
  }
  std::ranges::sort(large);
  auto const repeated = std::ranges::unique(large);
  large.erase(repeated.begin(), repeated.end());
  for (auto const* part : large) node.bytes += part->bytes;
}

void count_children(TaskNode& node) {
  auto const each = [&](std::vector<TaskTree> const& parts) {
    for (auto const& part : parts) count_child(node, part);
    count_large(node, parts);
  };
  auto const branches = [&](std::vector<Branch> const& all) {
    std::vector<TaskTree> parts;
    for (auto const& branch : all) parts.push_back(branch.then);
    each(parts);
  };
  std::visit(Overloaded{
                 [&](Sequence const& kind) { each(kind.parts); },
                 [&](Concurrent const& kind) { each(kind.parts); },
                 [&](Choice const& kind) { branches(kind.branches); },
                 [&](AllOf const& kind) { branches(kind.branches); },
                 [&](Until const& kind) { each({kind.body}); },
                 [&](During const& kind) { each({kind.body}); },
                 [&](Watch const& kind) { each({kind.body}); },
                 [&](Restricted const& kind) {
                   each({kind.body});
                   node.is_restricted = true;
                 },
                 [&](Performed const& kind) {
                   node.performed = 1;
                   node.bytes += kind.task->bytes();
                 },
                 [](Action const&) {},
                 [](Condition const&) {},
                 [](Idle const&) {},
             },
             node.kind);
}

TaskTree make(TaskKind kind, Origin origin) {
  std::size_t constexpr bytes_of_node = 256;  // guards and procedures included
  TaskNode node{.kind = std::move(kind), .origin = std::move(origin), .bytes = bytes_of_node};
  count_children(node);
  return std::make_shared<TaskNode const>(std::move(node));
}

/// The parts of `task` where it is one of `Kind` itself and has no name of its own, else the task.
template <class Kind>
void append_flat(std::vector<TaskTree>& parts, TaskTree task) {
  auto const* const same = std::get_if<Kind>(&task->kind);
  if (same && task->origin.label.empty()) {
    parts.insert(parts.end(), same->parts.begin(), same->parts.end());
  } else {
    parts.push_back(std::move(task));
  }
}

template <class Kind>
TaskTree join(TaskTree left, TaskTree right, Origin origin) {
  Kind kind;
  append_flat<Kind>(kind.parts, std::move(left));
  append_flat<Kind>(kind.parts, std::move(right));
  return make(std::move(kind), std::move(origin));
}

std::string joined_names(std::vector<TaskTree> const& parts, std::string_view separator) {
  std::size_t constexpr enough = 1000;
  std::string names;
  for (auto const& part : parts) {
    if (!names.empty()) names += separator;
    if (names.size() > enough) return names + "…";
    names += name(part);
  }
  return names;
}

}  // namespace

TaskTree sequence(TaskTree first, TaskTree second, Origin origin) {
  return join<Sequence>(std::move(first), std::move(second), std::move(origin));
}

TaskTree concurrent(TaskTree left, TaskTree right, Origin origin) {
  return join<Concurrent>(std::move(left), std::move(right), std::move(origin));
}

TaskTree until(TaskTree body, std::shared_ptr<Guard const> guard, Origin origin) {
  return make(Until{std::move(body), std::move(guard)}, std::move(origin));
}

TaskTree during(TaskTree body, base::Duration limit, Origin origin) {
  return make(During{std::move(body), limit}, std::move(origin));
}

base::Result<TaskTree> one_of(std::vector<Branch> branches, Origin origin) {
  if (branches.empty()) {
    return base::fail(base::ErrorKind::invalid_input, "No choices were defined!",
                      "give oneOf at least one `when {...} then ...`");
  }
  return make(Choice{std::move(branches)}, std::move(origin));
}

TaskTree wait_for(std::shared_ptr<Guard const> when, TaskTree then, Origin origin) {
  return make(Choice{{Branch{std::move(when), std::move(then)}}}, std::move(origin));
}

TaskTree all_of(std::vector<Branch> branches, Origin origin) {
  return make(AllOf{std::move(branches)}, std::move(origin));
}

TaskTree watch(TaskTree body, std::shared_ptr<Procedure const> on_error, Origin origin) {
  return make(Watch{std::move(body), std::move(on_error)}, std::move(origin));
}

TaskTree action(std::shared_ptr<Procedure const> body, Origin origin) {
  return make(Action{std::move(body)}, std::move(origin));
}

TaskTree condition(std::shared_ptr<Guard const> guard, Origin origin) {
  return make(Condition{std::move(guard)}, std::move(origin));
}

TaskTree idle(std::optional<base::Duration> length, Origin origin) {
  return make(Idle{length}, std::move(origin));
}

TaskTree restricted(TaskTree body, std::vector<VehicleId> vehicles, Origin origin) {
  return make(Restricted{std::move(body), std::move(vehicles)}, std::move(origin));
}

TaskTree performed(std::shared_ptr<PlatformTask const> task, Origin origin) {
  return make(Performed{std::move(task)}, std::move(origin));
}

std::string name(TaskTree const& task) {
  return std::visit(Overloaded{
                        [](Sequence const& kind) { return joined_names(kind.parts, " >> "); },
                        [](Concurrent const& kind) { return joined_names(kind.parts, " | "); },
                        [](Until const& kind) { return name(kind.body); },
                        [](During const& kind) { return name(kind.body); },
                        [](Restricted const& kind) { return name(kind.body); },
                        [](Choice const&) { return std::string("<choice>"); },
                        [](AllOf const&) { return std::string("<allOf>"); },
                        [](Watch const& kind) { return fmt::format("watcher<{}>", name(kind.body)); },
                        [](Action const&) { return std::string("<action>"); },
                        [](Condition const&) { return std::string("<condition>"); },
                        [](Idle const& kind) {
                          return kind.length ? fmt::format("idle({:f})", base::to_seconds(*kind.length)) : "idle()";
                        },
                        [](Performed const& kind) { return kind.task->name(); },
                    },
                    task->kind);
}

}  // namespace lapwing::tasks
