#include "map/store/sql/postgres.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <chrono>
#include <cstring>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "base/text/utc_text.hpp"
#include "map/store/sql/libpq.hpp"
#include "map/store/sql/wkb.hpp"

namespace lapwing::map::sql {

namespace {

struct Finish {
  void operator()(PGconn* connection) const { libpq().finish(connection); }
};
struct Clear {
  void operator()(PGresult* result) const { libpq().clear(result); }
};
using Connection = std::unique_ptr<PGconn, Finish>;
using Answer = std::unique_ptr<PGresult, Clear>;

/// A server that does not answer must not hold a station for ever, nor a station the others.
constexpr auto session_settings =
    "SET search_path = lapwing, public; SET client_min_messages = warning; SET lock_timeout = '10s'; "
    "SET statement_timeout = '10min'; SET idle_in_transaction_session_timeout = '30s'; SET TimeZone = 'UTC'";
constexpr std::array<std::pair<char const*, char const*>, 4> patience = {{{"connect_timeout", "5"},
                                                                          {"tcp_user_timeout", "10000"},
                                                                          {"keepalives_idle", "10"},
                                                                          {"application_name", "lapwing"}}};

/// Of a statement whose answer has not been asked for; more would fill the buffers of both sides.
constexpr std::size_t most_in_pipeline = 500;

/// Values in the form of a call to the server: text but for what is bytes.
class Parameters {
 public:
  explicit Parameters(Row const& values) {
    texts_.reserve(values.size());
    for (auto const& value : values) add(value);
    for (std::size_t i = 0; i < texts_.size(); ++i) {
      pointers_.push_back(texts_[i] ? texts_[i]->c_str() : nullptr);
      lengths_.push_back(texts_[i] ? static_cast<int>(texts_[i]->size()) : 0);
    }
  }
  [[nodiscard]] int count() const { return static_cast<int>(texts_.size()); }
  [[nodiscard]] char const* const* values() const { return pointers_.data(); }
  [[nodiscard]] int const* lengths() const { return lengths_.data(); }
  [[nodiscard]] int const* formats() const { return formats_.data(); }
  /// Texts end with a zero for the server: what is behind one would silently be lost.
  [[nodiscard]] bool has_zero_in_text() const { return has_zero_; }

 private:
  void add(Value const& value) {
    bool const is_binary = std::holds_alternative<Bytes>(value) || std::holds_alternative<Shape>(value);
    texts_.push_back(text_of(value));
    formats_.push_back(is_binary ? 1 : 0);
    has_zero_ = has_zero_ || (!is_binary && texts_.back() && texts_.back()->contains('\0'));
  }
  static std::optional<std::string> text_of(Value const& value) {
    if (auto const* truth = std::get_if<bool>(&value)) return *truth ? "t" : "f";
    if (auto const* number = std::get_if<std::int64_t>(&value)) return std::to_string(*number);
    if (auto const* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
    if (auto const* text = std::get_if<std::string>(&value)) return *text;
    if (auto const* bytes = std::get_if<Bytes>(&value)) return bytes->data;
    if (auto const* time = std::get_if<base::UtcTime>(&value)) return base::utc_text(*time);
    if (auto const* shape = std::get_if<Shape>(&value)) return ewkb(*shape);
    return std::nullopt;
  }

  std::vector<std::optional<std::string>> texts_;
  std::vector<char const*> pointers_;
  std::vector<int> lengths_;
  std::vector<int> formats_;
  bool has_zero_ = false;
};

template <class T>
T big_endian(char const* bytes) {
  std::array<char, sizeof(T)> turned;
  std::reverse_copy(bytes, bytes + sizeof(T), turned.begin());
  return std::bit_cast<T>(turned);
}

/// Of an answer in binary form. Numbers of types from `pg_type.dat`, which do not change.
Value column(PGresult const* answer, int row, int i) {
  if (libpq().is_null(answer, row, i) != 0) return std::monostate();
  char const* const bytes = libpq().value(answer, row, i);
  std::string whole(bytes, static_cast<std::size_t>(libpq().length(answer, row, i)));
  switch (libpq().type_of_column(answer, i)) {
    case 16: return *bytes != 0;                                    // bool
    case 20: return big_endian<std::int64_t>(bytes);                // int8
    case 21: return std::int64_t{big_endian<std::int16_t>(bytes)};  // int2
    case 23: return std::int64_t{big_endian<std::int32_t>(bytes)};  // int4
    case 700: return double{big_endian<float>(bytes)};              // float4
    case 701: return big_endian<double>(bytes);                     // float8
    case 1184: {                                                    // timestamptz: microseconds since 2000
      using std::chrono::year;
      auto const since = std::chrono::microseconds(big_endian<std::int64_t>(bytes));
      return base::UtcTime(std::chrono::sys_days(year(2000) / 1 / 1) + since);
    }
    case 25:
    case 1043:
    case 19: return whole;  // text, varchar, name
    default: return Bytes{std::move(whole)};
  }
}

base::ErrorKind kind_of(std::string_view state) {
  if (state.empty() || state.starts_with("08") || state.starts_with("57P")) return base::ErrorKind::lost;
  if (state.starts_with("53") || state.starts_with("58") || state.starts_with("XX")) return base::ErrorKind::io;
  if (state.starts_with("55") || state.starts_with("40") || state == "57014") return base::ErrorKind::timed_out;
  if (state.starts_with("23") || state.starts_with("28") || state == "42501" || state == "25006" ||
      state.starts_with("3D"))
    return base::ErrorKind::refused;
  return base::ErrorKind::invalid_input;
}

class Postgres final : public Database {
 public:
  Postgres(Connection connection, std::string name, Access access)
      : connection_(std::move(connection)), name_(std::move(name)), access_(access) {}

  [[nodiscard]] Dialect dialect() const override { return Dialect::postgis; }

  /// After the connection has been made, and made anew.
  base::Result<> settle() {
    prepared_.clear();
    is_in_transaction_ = false;
    auto settled = simply(session_settings);
    if (settled && access_ == Access::read) settled = simply("SET default_transaction_read_only = on");
    return settled;
  }

  base::Result<> execute(std::string const& statements) override {
    if (auto there = reach(); !there) return there;
    return simply(statements);
  }

  base::Result<> query(std::string const& statement, Row const& values, EachRow const& each) override {
    auto const answer = ask(statement, values);
    if (!answer) return std::unexpected(answer.error());
    int const columns = libpq().columns(answer->get());
    Row row(static_cast<std::size_t>(columns));
    for (int i = 0; i < libpq().rows(answer->get()); ++i) {
      for (int k = 0; k < columns; ++k) row[static_cast<std::size_t>(k)] = column(answer->get(), i, k);
      if (auto taken = each(row); !taken) return taken;
    }
    return {};
  }

  base::Result<std::uint64_t> change(std::string const& statement, Row const& values) override {
    auto const answer = ask(statement, values);
    if (!answer) return std::unexpected(answer.error());
    std::string_view const count = libpq().changed_rows(answer->get());
    std::uint64_t changed = 0;
    std::from_chars(count.data(), count.data() + count.size(), changed);
    return changed;
  }

  base::Result<> change_each(std::string const& statement, std::vector<Row> const& all) override {
    if (all.empty()) return {};
    if (auto there = reach(); !there) return there;
    auto const prepared = prepare(statement);
    if (!prepared) return std::unexpected(prepared.error());
    for (std::size_t begin = 0; begin < all.size(); begin += most_in_pipeline) {
      auto const end = std::min(all.size(), begin + most_in_pipeline);
      if (auto done = pipe(*prepared, std::span(all).subspan(begin, end - begin)); !done) return done;
    }
    return {};
  }

  base::Result<> put(Table const& table, std::vector<std::string> const& columns,
                     std::vector<Row> const& rows) override {
    std::string assignments;
    for (auto const& column : columns)
      if (std::ranges::find(table.key, column) == table.key.end())
        assignments += fmt::format("{}\"{}\" = excluded.\"{}\"", assignments.empty() ? "" : ", ", column, column);
    return change_each(fmt::format("INSERT INTO {} ({}) VALUES ({}) ON CONFLICT ({}) DO {}", table.name,
                                   comma_separated(columns), placeholders(columns.size()), comma_separated(table.key),
                                   assignments.empty() ? "NOTHING" : "UPDATE SET " + assignments),
                       rows);
  }

  base::Result<> begin() override {
    if (auto there = reach(); !there) return there;
    auto begun = simply("BEGIN");
    is_in_transaction_ = begun.has_value();
    return begun;
  }
  base::Result<> commit() override {
    auto const answer = Answer(libpq().execute(connection_.get(), "COMMIT"));
    if (libpq().result_status(answer.get()) != PGRES_COMMAND_OK) return fault(answer.get());
    is_in_transaction_ = false;
    // What a failed transaction answers to COMMIT.
    if (std::string_view(libpq().command_status(answer.get())) == "ROLLBACK")
      return base::fail(base::ErrorKind::io, name_ + ": the transaction had failed before");
    return {};
  }
  void roll_back() override {
    is_in_transaction_ = false;
    if (libpq().status(connection_.get()) == CONNECTION_OK) Answer(libpq().execute(connection_.get(), "ROLLBACK"));
  }

 private:
  base::Result<> reach() {
    if (is_in_transaction_ || libpq().status(connection_.get()) == CONNECTION_OK) return {};
    libpq().reset(connection_.get());
    if (libpq().status(connection_.get()) != CONNECTION_OK) return fault(nullptr);
    return settle();
  }

  base::Result<> simply(std::string const& statements) {
    auto const answer = Answer(libpq().execute(connection_.get(), statements.c_str()));
    auto const status = libpq().result_status(answer.get());
    if (status != PGRES_COMMAND_OK && status != PGRES_TUPLES_OK && status != PGRES_EMPTY_QUERY)
      return fault(answer.get());
    return {};
  }

  base::Result<Answer> ask(std::string const& statement, Row const& values) {
    if (auto there = reach(); !there) return std::unexpected(there.error());
    auto const prepared = prepare(statement);
    if (!prepared) return std::unexpected(prepared.error());
    Parameters const parameters(used(values, *prepared));
    if (parameters.has_zero_in_text()) return zero_in_text();
    constexpr int binary = 1;
    Answer answer(libpq().execute_prepared(connection_.get(), prepared->name.c_str(), parameters.count(),
                                           parameters.values(), parameters.lengths(), parameters.formats(), binary));
    auto const status = libpq().result_status(answer.get());
    if (status != PGRES_COMMAND_OK && status != PGRES_TUPLES_OK) return fault(answer.get());
    return answer;
  }

  struct Prepared {
    std::string name;
    std::size_t parameters;
  };

  /// A statement that does not use the last ones is content without.
  static Row used(Row const& values, Prepared const& prepared) {
    return {values.begin(), values.begin() + static_cast<std::ptrdiff_t>(std::min(values.size(), prepared.parameters))};
  }

  base::Result<Prepared> prepare(std::string const& statement) {
    if (auto const known = prepared_.find(statement); known != prepared_.end()) return known->second;
    auto const name = fmt::format("s{}", prepared_.size());
    Answer const made(libpq().prepare(connection_.get(), name.c_str(), statement.c_str(), 0, nullptr));
    if (libpq().result_status(made.get()) != PGRES_COMMAND_OK) return fault(made.get());
    Answer const described(libpq().describe_prepared(connection_.get(), name.c_str()));
    if (libpq().result_status(described.get()) != PGRES_COMMAND_OK) return fault(described.get());
    Prepared prepared{name, static_cast<std::size_t>(libpq().parameters(described.get()))};
    return prepared_.emplace(statement, std::move(prepared)).first->second;
  }

  base::Result<> pipe(Prepared const& prepared, std::span<Row const> rows) {
    auto* const connection = connection_.get();
    if (libpq().enter_pipeline(connection) != 1) return fault(nullptr);
    std::optional<std::unexpected<base::Error>> failed;
    std::size_t sent = 0;
    for (auto const& row : rows) {
      Parameters const parameters(row);
      if (parameters.has_zero_in_text()) failed = zero_in_text();
      if (failed) break;
      if (libpq().send_prepared(connection, prepared.name.c_str(), parameters.count(), parameters.values(),
                                parameters.lengths(), parameters.formats(), 0) != 1)
        failed = fault(nullptr);
      else
        ++sent;
    }
    if (libpq().sync_pipeline(connection) != 1 && !failed) failed = fault(nullptr);
    collect(sent, failed);
    libpq().exit_pipeline(connection);
    if (failed) return *failed;
    return {};
  }

  /// The answers of a pipeline; the first error is the one that counts: those behind it only say that it was there.
  void collect(std::size_t sent, std::optional<std::unexpected<base::Error>>& failed) {
    for (std::size_t ends = 0; ends <= sent;) {
      Answer const answer(libpq().next_result(connection_.get()));
      if (!answer) {
        // One stands behind the answer to each statement; none comes when there is no connection any more.
        if (libpq().status(connection_.get()) != CONNECTION_OK) {
          if (!failed) failed = fault(nullptr);
          return;
        }
        ++ends;
        continue;
      }
      auto const status = libpq().result_status(answer.get());
      if (status == PGRES_PIPELINE_SYNC) return;
      if (status != PGRES_COMMAND_OK && status != PGRES_TUPLES_OK && status != PGRES_PIPELINE_ABORTED && !failed)
        failed = fault(answer.get());
    }
  }

  [[nodiscard]] std::unexpected<base::Error> zero_in_text() const {
    return base::fail(base::ErrorKind::invalid_input, name_ + ": a text has a zero byte in it");
  }

  [[nodiscard]] std::unexpected<base::Error> fault(PGresult const* answer) const {
    char const* const state = answer ? libpq().error_field(answer, PG_DIAG_SQLSTATE) : nullptr;
    std::string message = answer ? libpq().result_message(answer) : "";
    if (message.empty()) message = libpq().error_message(connection_.get());
    while (!message.empty() && (message.back() == '\n' || message.back() == ' ')) message.pop_back();
    std::ranges::replace(message, '\n', ' ');
    auto kind = kind_of(state ? state : "");
    if (libpq().status(connection_.get()) != CONNECTION_OK) kind = base::ErrorKind::lost;
    auto const* const hint = kind == base::ErrorKind::lost ? "see that the server runs and can be reached"
                             : kind == base::ErrorKind::io ? "see to the server's disk and memory"
                                                           : "";
    return base::fail(kind, fmt::format("{}: {}", name_, message), hint);
  }

  Connection connection_;
  std::string name_;
  Access access_;
  std::map<std::string, Prepared> prepared_;
  bool is_in_transaction_ = false;
};

}  // namespace

base::Result<std::unique_ptr<Database>> open_postgres(std::string const& address, std::string const& name,
                                                      Access access) {
  if (auto const& problem = libpq().problem; !problem.empty()) {
    return base::fail(base::ErrorKind::io, fmt::format("{}: {}", name, problem),
                      "install PostgreSQL's client library (Debian: libpq5), or keep the store in a file");
  }
  std::vector<char const*> words, values;
  // First ours, then the address: what stands there counts.
  for (auto const& [word, value] : patience) {
    words.push_back(word);
    values.push_back(value);
  }
  words.insert(words.end(), {"dbname", nullptr});
  values.insert(values.end(), {address.c_str(), nullptr});
  constexpr int expand = 1;
  Connection connection(libpq().connect(words.data(), values.data(), expand));
  if (!connection || libpq().status(connection.get()) != CONNECTION_OK) {
    std::string message = connection ? libpq().error_message(connection.get()) : "no memory";
    while (message.ends_with('\n')) message.pop_back();
    return base::fail(base::ErrorKind::lost, fmt::format("{}: {}", name, message),
                      "see that the server runs, and that the address names its host, database and user");
  }
  libpq().set_notice_processor(connection.get(), [](void*, char const*) {}, nullptr);
  auto database = std::make_unique<Postgres>(std::move(connection), name, access);
  if (auto settled = database->settle(); !settled) return std::unexpected(settled.error());
  return database;
}

}  // namespace lapwing::map::sql
