#include "lsp/server.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/text/json.hpp"
#include "missions/vocabulary.hpp"

namespace lapwing::lsp {
namespace {

constexpr auto uri = "file:///test.dolphin";

/// A server, and what it says.
class Talk {
 public:
  explicit Talk(std::string const& script = {}, bool with_snippets = false) {
    Json const item{{"snippetSupport", with_snippets}};
    ask("initialize", {{"capabilities", {{"textDocument", {{"completion", {{"completionItem", item}}}}}}}});
    tell("initialized", Json::object());
    if (!script.empty()) open(script);
  }

  void queue(Json const& message) { server.receive(base::to_text(message)); }
  std::vector<Json> step() {
    std::vector<Json> out;
    for (auto const& one : server.work(now)) out.push_back(Json::parse(one));
    return out;
  }
  /// Nobody types for so long; what the server says of itself then.
  std::vector<Json> wait(base::Duration duration) {
    now += duration;
    std::vector<Json> out;
    while (server.has_work(now)) std::ranges::copy(step(), std::back_inserter(out));
    return out;
  }
  std::vector<Json> tell(std::string const& method, Json const& parameters) {
    queue({{"jsonrpc", "2.0"}, {"method", method}, {"params", parameters}});
    return step();
  }
  /// The whole answer.
  Json answer(std::string const& method, Json const& parameters) {
    queue({{"jsonrpc", "2.0"}, {"id", ++id}, {"method", method}, {"params", parameters}});
    auto const out = step();
    EXPECT_EQ(out.size(), 1u) << method;
    EXPECT_EQ(out.front()["id"], id);
    return out.front();
  }
  Json ask(std::string const& method, Json const& parameters) {
    auto const out = answer(method, parameters);
    EXPECT_TRUE(out.contains("result")) << out;
    return member(out, "result");
  }
  int error(std::string const& method, Json const& parameters) {
    return answer(method, parameters)["error"]["code"].get<int>();
  }

  std::vector<Json> open(std::string const& script) {
    EXPECT_TRUE(
        tell("textDocument/didOpen", {{"textDocument", {{"uri", uri}, {"version", 1}, {"text", script}}}}).empty());
    return wait(base::Duration::zero());
  }
  /// Somebody types one letter.
  void type(int line, int character, std::string const& letter) {
    Json const place{{"line", line}, {"character", character}};
    Json const change{{"range", {{"start", place}, {"end", place}}}, {"text", letter}};
    EXPECT_TRUE(tell("textDocument/didChange",
                     {{"textDocument", {{"uri", uri}, {"version", ++version}}}, {"contentChanges", {change}}})
                    .empty());
  }
  static Json at(int line, int character) {
    return {{"textDocument", {{"uri", uri}}}, {"position", {{"line", line}, {"character", character}}}};
  }

  tasks::Vocabulary vocabulary = missions::vocabulary();
  Server server{vocabulary, "1.2.3"};
  base::TimePoint now{};
  int id = 0;
  int version = 1;
};

TEST(Server, TellsWhatItCanDo) {
  tasks::Vocabulary const vocabulary = missions::vocabulary();
  Server server(vocabulary, "1.2.3");
  server.receive(R"({"jsonrpc":"2.0","id":"a","method":"initialize","params":{}})");
  auto const out = Json::parse(server.work({}).at(0));
  EXPECT_EQ(out["id"], "a");
  EXPECT_EQ(out["jsonrpc"], "2.0");
  EXPECT_EQ(out["result"]["serverInfo"]["version"], "1.2.3");
  auto const& can = out["result"]["capabilities"];
  EXPECT_EQ(can["textDocumentSync"]["change"], 2);
  EXPECT_EQ(can["codeActionProvider"]["codeActionKinds"], Json::array({"quickfix"}));
  EXPECT_EQ(can["semanticTokensProvider"]["legend"]["tokenTypes"].size(), 10u);
}

TEST(Server, GoesThroughItsLife) {
  tasks::Vocabulary const vocabulary;
  Server server(vocabulary, "1");
  auto const code = [&](char const* message) {
    server.receive(message);
    auto const out = server.work({});
    return out.empty() ? Json() : member(member(Json::parse(out[0]), "error"), "code");
  };
  EXPECT_EQ(code(R"({"id":1,"method":"textDocument/hover","params":{}})"), -32002);
  EXPECT_TRUE(code(R"({"id":2,"method":"initialize","params":{}})").is_null());
  EXPECT_EQ(code(R"({"id":3,"method":"initialize","params":{}})"), -32803);
  EXPECT_EQ(code(R"({"id":4,"method":"textDocument/dance","params":{}})"), -32601);
  EXPECT_TRUE(code(R"({"method":"$/unknown","params":{}})").is_null()) << "notifications are never answered";
  EXPECT_TRUE(code(R"({"id":5,"method":"shutdown"})").is_null());
  EXPECT_EQ(code(R"({"id":6,"method":"textDocument/hover","params":{}})"), -32600);
  EXPECT_FALSE(server.exit_code());
  EXPECT_TRUE(code(R"({"method":"exit"})").is_null());
  EXPECT_EQ(server.exit_code(), 0);
}

TEST(Server, EndsWithOneWhenItWasNotShutDown) {
  Talk talk;
  talk.tell("exit", Json::object());
  EXPECT_EQ(talk.server.exit_code(), 1);
}

TEST(Server, AnswersWhatItCannotRead) {
  Talk talk;
  for (auto const& [message, code] : std::initializer_list<std::pair<char const*, int>>{
           {"{", -32700},
           {"[]", -32600},
           {"17", -32600},
           {R"({"id":1})", -32600},
           {R"({"id":1.5,"method":"x"})", -32600},
           {R"({"id":null,"method":"x"})", -32600},
           {R"({"id":1,"method":"textDocument/hover"})", -32602},
           {R"({"id":1,"method":"textDocument/hover","params":[1,2]})", -32602},
           {R"({"id":1,"method":"textDocument/hover","params":{"textDocument":{"uri":7},"position":null}})", -32602},
       }) {
    talk.server.receive(message);
    auto const out = talk.step();
    ASSERT_EQ(out.size(), 1u) << message;
    EXPECT_EQ(out[0]["error"]["code"], code) << message;
  }
  talk.server.receive_mistake("noise");
  EXPECT_EQ(talk.step()[0]["error"]["code"], -32700);
  talk.server.receive(R"({"id":9,"result":null})");
  EXPECT_TRUE(talk.step().empty()) << "an answer to nothing";
}

TEST(Server, RefusesPlacesThatMakeNoSense) {
  Talk talk("x = 1\n");
  auto const where = [](Json line) {
    return Json{{"textDocument", {{"uri", uri}}}, {"position", {{"line", std::move(line)}, {"character", 0}}}};
  };
  EXPECT_EQ(talk.error("textDocument/hover", where(-1)), -32602);
  EXPECT_EQ(talk.error("textDocument/hover", where("0")), -32602);
  EXPECT_TRUE(talk.ask("textDocument/hover", where(4'000'000'000u)).is_null());
}

TEST(Server, CancelsARequestBeforeItsTurn) {
  Talk talk("x = 1\n");
  talk.queue({{"id", 70}, {"method", "textDocument/hover"}, {"params", Talk::at(0, 0)}});
  talk.queue({{"id", 71}, {"method", "textDocument/hover"}, {"params", Talk::at(0, 0)}});
  talk.queue({{"method", "$/cancelRequest"}, {"params", {{"id", 70}}}});
  EXPECT_EQ(talk.step()[0]["error"]["code"], -32800);
  EXPECT_TRUE(talk.step()[0].contains("result"));
  EXPECT_FALSE(talk.server.has_work(talk.now)) << "cancelling what is done, or unknown, is no mistake";
}

TEST(Server, PublishesDiagnosticsWithCodesAndQuickFixes) {
  Talk talk;
  auto const out = talk.open("m = mission {\n  takeoff location(1, 2)\n}\n");
  ASSERT_EQ(out.size(), 1u);
  auto const& all = out[0]["params"]["diagnostics"];
  ASSERT_EQ(all.size(), 1u) << out[0];
  EXPECT_EQ(all[0]["code"], "unknown-instruction");
  EXPECT_EQ(all[0]["severity"], 1);
  EXPECT_EQ(all[0]["range"]["start"], (Json{{"line", 1}, {"character", 2}}));
  EXPECT_EQ(all[0]["range"]["end"], (Json{{"line", 1}, {"character", 9}}));
  Json parameters{{"textDocument", {{"uri", uri}}}, {"range", all[0]["range"]}, {"context", Json::object()}};
  auto const actions = talk.ask("textDocument/codeAction", parameters);
  ASSERT_EQ(actions.size(), 1u);
  EXPECT_EQ(actions[0]["edit"]["changes"][uri][0]["newText"], "takeOff");
  EXPECT_EQ(actions[0]["diagnostics"][0]["code"], "unknown-instruction");
}

TEST(Server, OffersEachFixAsAnEditThatSaysWhatItDoes) {
  struct Case {
    std::string_view script;
    std::string_view title;
    std::size_t edits;
  };
  for (auto const& [script, title, edits] : std::initializer_list<Case>{
           {"v = pick { type 'UVA' }", "Change to UAV", 1},
           {"idle(5)", "Insert execute", 1},
           {"(idle(5) | idle(6)) / { true }", "Change to execute((idle(5) | idle(6)) / { true })", 2},
           {"v = pick { }\nmessage(battery(v) < 30)", "Insert .percent", 1},
       }) {
    Talk talk;
    auto const all = talk.open(std::string(script)).at(0)["params"]["diagnostics"];
    ASSERT_EQ(all.size(), 1u) << all;
    Json const parameters{{"textDocument", {{"uri", uri}}}, {"range", all[0]["range"]}, {"context", Json::object()}};
    auto const actions = talk.ask("textDocument/codeAction", parameters);
    ASSERT_EQ(actions.size(), 1u) << script;
    EXPECT_EQ(actions[0]["title"], title);
    EXPECT_EQ(actions[0]["edit"]["changes"][uri].size(), edits);
  }
}

TEST(Server, ChecksAScriptOnceWhenNobodyTypesAnyMore) {
  Talk talk("x = 1\nmessage y\n");
  auto const before = talk.server.effort();
  for (int i = 0; i < 20; ++i) {
    talk.type(0, 5 + i, "1");
    EXPECT_TRUE(talk.wait(Server::pause - std::chrono::milliseconds(1)).empty()) << "the next key puts the check off";
  }
  EXPECT_EQ(talk.server.effort().readings, before.readings);
  EXPECT_EQ(talk.server.effort().checks, before.checks);
  auto const out = talk.wait(std::chrono::milliseconds(1));
  ASSERT_EQ(out.size(), 1u);
  EXPECT_EQ(out[0]["params"]["version"], 21);
  EXPECT_EQ(out[0]["params"]["diagnostics"].size(), 2u) << "the number has become too large, and there is no y";
  EXPECT_EQ(talk.server.effort().readings, before.readings + 1);
  EXPECT_EQ(talk.server.effort().checks, before.checks + 1);
  EXPECT_FALSE(talk.server.next_due());
}

TEST(Server, AnswersAboutTheTextOfNowWithoutACheck) {
  Talk talk("alpha = 1\nmessage a\n");
  auto const before = talk.server.effort();
  for (char const letter : std::string("lpha")) {
    auto const column = 9 + (static_cast<int>(std::string("lpha").find(letter)));
    talk.type(1, column, std::string(1, letter));
  }
  EXPECT_EQ(talk.ask("textDocument/definition", Talk::at(1, 10))[0]["range"]["start"]["line"], 0);
  EXPECT_FALSE(talk.ask("textDocument/hover", Talk::at(1, 10)).is_null());
  EXPECT_FALSE(talk.ask("textDocument/completion", Talk::at(1, 10))["items"].empty());
  EXPECT_EQ(talk.server.effort().readings, before.readings + 1) << "once for all questions about one text";
  EXPECT_EQ(talk.server.effort().checks, before.checks);
}

TEST(Server, OffersFixesOfTheTextOfNow) {
  Talk talk("x = 1\n");
  talk.type(0, 5, "\nmessage xx");
  Json parameters{{"textDocument", {{"uri", uri}}},
                  {"range", {{"start", {{"line", 1}, {"character", 8}}}, {"end", {{"line", 1}, {"character", 8}}}}}};
  parameters["context"]["triggerKind"] = 2;
  EXPECT_TRUE(talk.ask("textDocument/codeAction", parameters).empty())
      << "the editor's own question waits for the check";
  parameters["context"]["triggerKind"] = 1;
  EXPECT_EQ(talk.ask("textDocument/codeAction", parameters).size(), 1u);
  parameters["context"]["triggerKind"] = 2;
  EXPECT_EQ(talk.ask("textDocument/codeAction", parameters).size(), 1u);
  EXPECT_EQ(talk.wait(Server::pause).size(), 1u) << "the diagnostics are told all the same";
}

TEST(Server, FollowsChangesAndPublishesOnceForABurst) {
  Talk talk("x = 1\nmessage y\n");
  auto const change = [](int version, Json changes) {
    return Json{{"method", "textDocument/didChange"},
                {"params", {{"textDocument", {{"uri", uri}, {"version", version}}}, {"contentChanges", changes}}}};
  };
  Json const first{{"range", {{"start", {{"line", 1}, {"character", 8}}}, {"end", {{"line", 1}, {"character", 9}}}}},
                   {"text", "x"}};
  talk.queue(change(2, Json::array({first})));
  talk.queue(change(3, Json::array({{{"text", "message 'ä🐦' + z\n"}}})));
  EXPECT_TRUE(talk.step().empty());
  EXPECT_TRUE(talk.step().empty());
  auto const out = talk.wait(Server::pause);
  ASSERT_EQ(out.size(), 1u);
  EXPECT_EQ(out[0]["params"]["version"], 3);
  EXPECT_EQ(out[0]["params"]["diagnostics"][0]["range"]["start"]["character"], 16);
  auto const closed = talk.tell("textDocument/didClose", {{"textDocument", {{"uri", uri}}}});
  EXPECT_TRUE(closed[0]["params"]["diagnostics"].empty());
  EXPECT_EQ(talk.error("textDocument/hover", Talk::at(0, 0)), -32602);
}

TEST(Server, AnswersQuestionsAboutAWord) {
  Talk talk("v1 = pick { count 1 }\nexecute v1: task('a')\nrelease v1\n");
  auto const shown = talk.ask("textDocument/hover", Talk::at(2, 9));
  EXPECT_NE(shown["contents"]["value"].get<std::string>().find("a set of vehicles"), std::string::npos) << shown;
  EXPECT_EQ(talk.ask("textDocument/definition", Talk::at(2, 9))[0]["range"]["start"]["line"], 0);
  EXPECT_EQ(talk.ask("textDocument/documentHighlight", Talk::at(2, 9)).size(), 3u);
  auto parameters = Talk::at(2, 9);
  parameters["context"]["includeDeclaration"] = false;
  EXPECT_EQ(talk.ask("textDocument/references", parameters).size(), 2u);
  EXPECT_EQ(talk.ask("textDocument/prepareRename", Talk::at(2, 9))["placeholder"], "v1");
  parameters["newName"] = "scout";
  EXPECT_EQ(talk.ask("textDocument/rename", parameters)["changes"][uri].size(), 3u);
  parameters["newName"] = "if";
  EXPECT_EQ(talk.error("textDocument/rename", parameters), -32602);
  EXPECT_EQ(talk.error("textDocument/prepareRename", Talk::at(0, 6)), -32803);
  EXPECT_EQ(talk.ask("textDocument/documentSymbol", Talk::at(0, 0))[0]["name"], "v1");
}

TEST(Server, CompletesWithSnippetsOnlyWhereTheEditorTakesThem) {
  for (bool const with_snippets : {false, true}) {
    Talk talk("x = 1\n\n", with_snippets);
    auto const items = talk.ask("textDocument/completion", Talk::at(1, 0))["items"];
    auto const found = std::ranges::find_if(items, [](Json const& one) { return one["label"] == "pick"; });
    ASSERT_NE(found, items.end());
    EXPECT_EQ((*found)["insertTextFormat"], with_snippets ? 2 : 1);
    EXPECT_EQ((*found)["textEdit"]["newText"], with_snippets ? "pick {\n  $0\n}" : "pick");
  }
}

TEST(Server, OpensAListAtTheParenthesisOfCatchAlone) {
  Talk talk("try { } catch (\nx = sqrt(\n");
  auto const offered = [&](int line, int character) {
    auto parameters = Talk::at(line, character);
    parameters["context"] = {{"triggerKind", 2}, {"triggerCharacter", "("}};
    return talk.ask("textDocument/completion", parameters)["items"].size();
  };
  EXPECT_GT(offered(0, 15), 3u);
  EXPECT_EQ(offered(1, 9), 0u);
}

TEST(Server, FormatsWithOneEditAndLeavesBrokenScriptsAlone) {
  Talk talk("x=1\ny = 2\n");
  Json const parameters{{"textDocument", {{"uri", uri}}}, {"options", Json::object()}};
  auto const edits = talk.ask("textDocument/formatting", parameters);
  ASSERT_EQ(edits.size(), 1u);
  EXPECT_EQ(edits[0]["newText"], " = ");
  EXPECT_EQ(edits[0]["range"]["start"], (Json{{"line", 0}, {"character", 1}}));
  Talk broken("x = (1\n");
  EXPECT_TRUE(broken.ask("textDocument/formatting", parameters).empty());
}

TEST(Server, FormatsOnlyTheLinesThatAreSelected) {
  Talk talk("a=1\nif (a) {\n\n\n      b=2\n   c=3\n}\nd=4\n");
  auto const format = [&](int first, int last, int column) {
    return talk.ask(
        "textDocument/rangeFormatting",
        {{"textDocument", {{"uri", uri}}},
         {"options", Json::object()},
         {"range",
          {{"start", {{"line", first}, {"character", 0}}}, {"end", {{"line", last}, {"character", column}}}}}});
  };
  auto const one = format(4, 4, 9);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0]["range"]["start"], (Json{{"line", 4}, {"character", 2}}));
  EXPECT_EQ(one[0]["newText"], "b = ");
  auto const two = format(4, 6, 0);
  ASSERT_EQ(two.size(), 1u);
  EXPECT_EQ(two[0]["newText"], "b = 2\n  c = ");
  EXPECT_TRUE(format(6, 6, 1).empty()) << "nothing to do";
  EXPECT_TRUE(format(2, 3, 0).empty()) << "blank lines alone are left";
}

TEST(Server, FoldsAndSelectsAndHints) {
  Talk talk("m = mission {\n  home 41, -8, 90\n  takeOff location(41, -8, 120)\n}\n");
  Json const whole{{"textDocument", {{"uri", uri}}},
                   {"range", {{"start", {{"line", 0}, {"character", 0}}}, {"end", {{"line", 9}, {"character", 0}}}}}};
  EXPECT_EQ(talk.ask("textDocument/foldingRange", whole), (Json::array({{{"startLine", 0}, {"endLine", 2}}})));
  auto const hints = talk.ask("textDocument/inlayHint", whole);
  auto const high = std::ranges::find_if(hints, [](Json const& one) { return one["label"] == " 30 m above home"; });
  ASSERT_NE(high, hints.end()) << hints;
  EXPECT_EQ((*high)["position"], (Json{{"line", 2}, {"character", 31}}));
  auto const chosen = talk.ask("textDocument/selectionRange",
                               {{"textDocument", {{"uri", uri}}}, {"positions", {{{"line", 2}, {"character", 4}}}}});
  ASSERT_EQ(chosen.size(), 1u);
  EXPECT_EQ(chosen[0]["range"]["end"], (Json{{"line", 2}, {"character", 9}})) << "takeOff";
  EXPECT_EQ(chosen[0]["parent"]["range"]["end"], (Json{{"line", 2}, {"character", 31}}));
  EXPECT_EQ(talk.error("textDocument/inlayHint", {{"textDocument", {{"uri", uri}}}}), -32602) << "without a range";
}

TEST(Server, FindsSymbolsInAllOpenScripts) {
  Talk talk("surveyNorth = mission { }\nv = pick { }\n");
  talk.tell("textDocument/didOpen",
            {{"textDocument", {{"uri", "file:///b.dolphin"}, {"version", 1}, {"text", "south = 1\n"}}}});
  auto const names = [&](char const* query) {
    std::vector<std::string> out;
    for (auto const& one : talk.ask("workspace/symbol", {{"query", query}})) out.push_back(one["name"]);
    return out;
  };
  EXPECT_EQ(names("").size(), 3u);
  EXPECT_EQ(names("sth"), (std::vector<std::string>{"south", "surveyNorth"}));
  EXPECT_EQ(names("SNORTH"), std::vector<std::string>{"surveyNorth"});
  EXPECT_TRUE(names("zz").empty());
}

TEST(Server, LeavesQuestionsAboutATextThatHasChangedSince) {
  Talk talk("x = 1\n");
  auto const before = talk.server.effort();
  talk.queue(
      {{"id", 80}, {"method", "textDocument/semanticTokens/full"}, {"params", {{"textDocument", {{"uri", uri}}}}}});
  talk.queue({{"id", 81}, {"method", "textDocument/hover"}, {"params", Talk::at(0, 0)}});
  talk.queue(
      {{"method", "textDocument/didChange"},
       {"params", {{"textDocument", {{"uri", uri}, {"version", 2}}}, {"contentChanges", {{{"text", "y = 1\n"}}}}}}});
  EXPECT_EQ(talk.step()[0]["error"]["code"], -32801) << "the editor asks again";
  EXPECT_TRUE(talk.step()[0].contains("result"));
  EXPECT_TRUE(talk.step().empty());
  EXPECT_EQ(talk.server.effort().readings, before.readings);
}

TEST(Server, EncodesSemanticTokensRelativeToEachOther) {
  Talk talk("x = 1 // ä\ny = x\n");
  auto const data = talk.ask("textDocument/semanticTokens/full", {{"textDocument", {{"uri", uri}}}})["data"];
  EXPECT_EQ(data, (Json{0, 0, 1, 0, 1, 0, 4, 1, 8, 0, 0, 2, 4, 9, 0, 1, 0, 1, 0, 1, 0, 4, 1, 0, 0}));
}

TEST(Server, HelpsWithSignatures) {
  Talk talk("x = location(1, \n");
  auto const help = talk.ask("textDocument/signatureHelp", Talk::at(0, 16));
  EXPECT_EQ(help["activeParameter"], 1);
  EXPECT_EQ(help["signatures"][0]["parameters"][1]["label"], "lon");
}

}  // namespace
}  // namespace lapwing::lsp
