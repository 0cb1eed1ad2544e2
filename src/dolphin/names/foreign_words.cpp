#include "dolphin/names/foreign_words.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <utility>

namespace lapwing::dolphin {

namespace {

/// A word of theirs and what to write or what it means.
struct Word {
  std::string_view theirs;
  std::string_view ours;
};

constexpr auto names = std::to_array<Word>({
    {"True", "write true"},
    {"TRUE", "write true"},
    {"False", "write false"},
    {"FALSE", "write false"},
    {"None", "write null"},
    {"nil", "write null"},
    {"NULL", "write null"},
    {"nullptr", "write null"},
    {"undefined", "write null"},
    {"nan", "write NaN"},
    {"Infinity", "write Double.POSITIVE_INFINITY"},
    {"self", "there are no objects of one's own; use variables and closures"},
    {"this", "there are no objects of one's own; use variables and closures"},
    {"pass", "an empty block is { }"},
    {"not", "write !(...)"},
    {"console", "message 'text' prints for the operator"},
});

constexpr auto calls = std::to_array<Word>({
    {"wait", "pause 5 waits 5 seconds"},
    {"sleep", "pause 5 waits 5 seconds"},
    {"echo", "message 'text' prints for the operator"},
    {"log", "message 'text' prints for the operator"},
    {"printf", "message String.format('%.1f m', x) prints for the operator"},
    {"sprintf", "write String.format('%.1f m', x)"},
    {"format", "write String.format('%.1f m', x)"},
    {"input", "ask 'question' waits for a line"},
    {"exit", "halt 'reason' ends the script"},
    {"quit", "halt 'reason' ends the script"},
    {"abort", "halt 'reason' ends the script"},
    {"run", "execute task runs a task"},
    {"start", "execute task runs a task"},
    {"fly", "execute task runs a task"},
    {"len", "write x.size()"},
    {"length", "write x.size()"},
    {"size", "write x.size()"},
    {"str", "write x.toString(), or \"$x\""},
    {"int", "write x as int"},
    {"float", "write x as double"},
    {"double", "write x as double"},
    {"bool", "write x as boolean"},
    {"list", "write x.toList(), or [1, 2]"},
    {"dict", "write [name: value]"},
    {"range", "write 0..<n"},
    {"enumerate", "write x.eachWithIndex { item, index -> ... }"},
    {"sum", "write x.sum()"},
    {"sorted", "write x.sort(false)"},
    {"map", "write x.collect { ... }"},
    {"filter", "write x.findAll { ... }"},
    {"reduce", "write x.inject { a, b -> ... }"},
    {"any", "write x.any { ... }"},
    {"all", "write x.every { ... }"},
    {"lambda", "write { x -> ... }"},
    {"not", "write !(...)"},
    {"raise", "write throw new RuntimeException('why')"},
    {"elif", "write else if (...) { ... }"},
    {"elsif", "write else if (...) { ... }"},
    {"elseif", "write else if (...) { ... }"},
    {"unless", "write if (!(...)) { ... }"},
    {"loop", "write while (true) { ... }"},
    {"repeat", "write n.times { ... }"},
    {"match", "write switch (x) { case 1: ... }"},
    {"except", "write catch (Exception e) { ... }"},
    {"emit", "post name: 1 posts a signal"},
    {"signal", "post name: 1 posts a signal"},
    {"arm", "a vehicle is armed when it begins a mission: execute v: mission { ... }"},
    {"disarm", "a vehicle disarms itself when it has landed; the operator's page has Disarm"},
    {"connect", "vehicles are found on the links: v = pick { type 'UAV' }"},
    {"parallel", "write execute a | b"},
    {"sequence", "write execute a >> b"},
});

constexpr auto mission_words = std::to_array<Word>({
    {"land", "write landingPoint location(...), or returnHomeAndLand()"},
    {"landHere", "write landingPoint location(...), or returnHomeAndLand()"},
    {"landHome", "write returnHomeAndLand()"},
    {"rtl", "write returnHomeAndLand(), or returnHome()"},
    {"RTL", "write returnHomeAndLand(), or returnHome()"},
    {"returnToLaunch", "write returnHomeAndLand(), or returnHome()"},
    {"goHome", "write returnHomeAndLand(), or returnHome()"},
    {"goto", "write goPos location(...)"},
    {"goTo", "write goPos location(...)"},
    {"go", "write goPos location(...), or move north, east"},
    {"flyTo", "write goPos location(...)"},
    {"fly", "write goPos location(...), or move north, east"},
    {"moveTo", "write goPos location(...), or move north, east"},
    {"waypoint", "write goPos location(...), or move north, east"},
    {"wp", "write goPos location(...), or move north, east"},
    {"arm", "a vehicle is armed when the mission begins"},
    {"hover", "write loiterTime position, seconds, or delay seconds"},
    {"hold", "write loiterTime position, seconds, or delay seconds"},
    {"loiter", "write loiterTime position, seconds, or loiterTurns position, turns"},
    {"circle", "write loiterTurns position, turns"},
    {"orbit", "write loiterTurns position, turns"},
    {"wait", "write delay seconds"},
    {"pause", "write delay seconds"},
    {"sleep", "write delay seconds"},
    {"photo", "write capturePhoto()"},
    {"survey", "write surveyArea place, length, width"},
    {"north", "write move north, east: move 50, 0"},
    {"jump", "write jumpToItem item, times"},
    {"climb", "write move 0, 0, up, or altitude metres"},
    {"launch", "write takeOff location(...)"},
});

constexpr auto methods_of_others = std::to_array<Word>({
    {"append", "write .add(x), or list << x"},
    {"appendAll", "write .addAll(list)"},
    {"extend", "write .addAll(list)"},
    {"insert", "write .add(index, x)"},
    {"shift", "write .removeAt(0)"},
    {"length", "write .size()"},
    {"len", "write .size()"},
    {"upper", "write .toUpperCase()"},
    {"uppercase", "write .toUpperCase()"},
    {"lower", "write .toLowerCase()"},
    {"lowercase", "write .toLowerCase()"},
    {"strip", "write .trim()"},
    {"charAt", "write text[index]"},
    {"slice", "write [from..to]"},
    {"substr", "write .substring(from, to)"},
    {"startswith", "write .startsWith(text)"},
    {"endswith", "write .endsWith(text)"},
    {"includes", "write .contains(x)"},
    {"has", "write .containsKey(key), or .contains(x)"},
    {"forEach", "write .each { ... }"},
    {"map", "write .collect { ... }"},
    {"filter", "write .findAll { ... }"},
    {"grep", "write .findAll { it ==~ /pattern/ }"},
    {"reduce", "write .inject { a, b -> ... }"},
    {"fold", "write .inject(start) { a, b -> ... }"},
    {"some", "write .any { ... }"},
    {"all", "write .every { ... }"},
    {"removeIf", "write list = list.findAll { !(...) }"},
    {"keys", "write .keySet()"},
    {"items", "write .each { key, value -> ... }"},
    {"entries", "write .entrySet()"},
    {"matcher", "write text =~ /pattern/"},
    {"group", "text =~ /(a)(b)/ is a list: write [0][1] for the first group of the first match"},
    {"toInt", "write .toInteger()"},
    {"toFixed", "write .round(places)"},
    {"sqrt", "write sqrt(x)"},
    {"ceil", "write ceil(x)"},
    {"floor", "write floor(x)"},
    {"pow", "write x ** n"},
});

constexpr auto unit_words = std::to_array<Word>({
    {"m", "meters"},
    {"meter", "meters"},
    {"metre", "meters"},
    {"metres", "meters"},
    {"kilometer", "km"},
    {"kilometre", "km"},
    {"kilometres", "kilometers"},
    {"s", "seconds"},
    {"sec", "seconds"},
    {"secs", "seconds"},
    {"second", "seconds"},
    {"min", "minutes"},
    {"mins", "minutes"},
    {"minute", "minutes"},
    {"h", "hours"},
    {"hr", "hours"},
    {"hour", "hours"},
    {"day", "days"},
    {"deg", "degrees"},
    {"degree", "degrees"},
    {"rad", "radians"},
    {"pct", "percent"},
    {"meters", "meters"},
    {"kilometers", "kilometers"},
    {"km", "km"},
    {"degrees", "degrees"},
    {"radians", "radians"},
    {"seconds", "seconds"},
    {"minutes", "minutes"},
    {"hours", "hours"},
    {"days", "days"},
    {"percent", "percent"},
});

constexpr auto vehicle_words = std::to_array<Word>({
    {"copter", "UAV"},      {"drone", "UAV"},      {"quadcopter", "UAV"}, {"quadrotor", "UAV"},  {"quad", "UAV"},
    {"multicopter", "UAV"}, {"multirotor", "UAV"}, {"hexacopter", "UAV"}, {"octocopter", "UAV"}, {"tricopter", "UAV"},
    {"helicopter", "UAV"},  {"heli", "UAV"},       {"plane", "UAV"},      {"airplane", "UAV"},   {"aircraft", "UAV"},
    {"fixedwing", "UAV"},   {"fixed wing", "UAV"}, {"fixed-wing", "UAV"}, {"vtol", "UAV"},       {"quadplane", "UAV"},
    {"glider", "UAV"},      {"uas", "UAV"},        {"rpas", "UAV"},       {"rover", "UGV"},      {"car", "UGV"},
    {"truck", "UGV"},       {"ground", "UGV"},     {"robot", "UGV"},      {"tractor", "UGV"},    {"mower", "UGV"},
    {"boat", "USV"},        {"ship", "USV"},       {"vessel", "USV"},     {"asv", "USV"},        {"sub", "UUV"},
    {"submarine", "UUV"},   {"auv", "UUV"},        {"rov", "UUV"},        {"underwater", "UUV"},
});

constexpr auto variable_words = std::to_array<std::string_view>({"const", "final", "let", "val", "var"});
constexpr auto function_words = std::to_array<std::string_view>({"fn", "fun", "func", "function"});

std::string_view find(std::span<Word const> table, std::string_view word) {
  auto const found = std::ranges::find(table, word, &Word::theirs);
  return found == table.end() ? std::string_view() : found->ours;
}

}  // namespace

std::string hint_for_name(std::string_view name) {
  return std::string(find(names, name));
}

std::string hint_for_call(std::string_view name) {
  return std::string(find(calls, name));
}

std::string hint_for_mission_word(std::string_view word) {
  return std::string(find(mission_words, word));
}

std::string hint_for_method(std::string_view name) {
  return std::string(find(methods_of_others, name));
}

std::string_view unit_meant(std::string_view word) {
  return find(unit_words, word);
}

std::string_view vehicle_type_meant(std::string_view word) {
  std::string small(word);
  std::ranges::transform(small, small.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return find(vehicle_words, small);
}

bool declares_variable(std::string_view word) {
  return std::ranges::find(variable_words, word) != variable_words.end();
}

bool declares_function(std::string_view word) {
  return std::ranges::find(function_words, word) != function_words.end();
}

}  // namespace lapwing::dolphin
