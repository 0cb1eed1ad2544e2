#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "map/store/sql/dialect.hpp"
#include "map/store/sql/table.hpp"
#include "map/store/sql/value.hpp"

namespace lapwing::map::sql {

/// One connection. Of one thread at a time; every call waits for the database.
///
/// Values stand in statements as $1, $2, ... Statements are prepared once and kept. Errors: io for a disk that is full
/// or broken, lost for a server that is away, timed_out for one that others keep busy, refused for what a constraint or
/// a permission forbids, invalid_input for statements that are none.
class Database {
 public:
  virtual ~Database() = default;

  [[nodiscard]] virtual Dialect dialect() const = 0;
  /// One or several statements without values.
  [[nodiscard]] virtual base::Result<> execute(std::string const& statements) = 0;
  /// Calls `each` for each row; an error of it ends the query.
  using EachRow = std::function<base::Result<>(Row const&)>;
  [[nodiscard]] virtual base::Result<> query(std::string const& statement, Row const& values, EachRow const& each) = 0;
  /// How many rows it changed.
  [[nodiscard]] virtual base::Result<std::uint64_t> change(std::string const& statement, Row const& values) = 0;
  /// The same statement with each of these values.
  [[nodiscard]] virtual base::Result<> change_each(std::string const& statement, std::vector<Row> const& all) = 0;
  /// Rows of a table by its key: over the old ones, or new. Each has `columns`, which the key is among.
  [[nodiscard]] virtual base::Result<> put(Table const& table, std::vector<std::string> const& columns,
                                           std::vector<Row> const& rows) = 0;

  [[nodiscard]] virtual base::Result<> begin() = 0;
  [[nodiscard]] virtual base::Result<> commit() = 0;
  /// Nothing to be done about an error: what the transaction has done is not there either way.
  virtual void roll_back() = 0;
};

/// Everything between its beginning and `commit` is there, or nothing of it.
class Transaction {
 public:
  [[nodiscard]] static base::Result<Transaction> begin(Database& database) {
    if (auto begun = database.begin(); !begun) return std::unexpected(begun.error());
    return Transaction(database);
  }
  Transaction(Transaction&& other) noexcept : database_(std::exchange(other.database_, nullptr)) {}
  Transaction& operator=(Transaction&&) = delete;
  ~Transaction() {
    if (database_) database_->roll_back();
  }
  [[nodiscard]] base::Result<> commit() {
    auto committed = database_->commit();
    if (committed) database_ = nullptr;
    return committed;
  }

 private:
  explicit Transaction(Database& database) : database_(&database) {}
  Database* database_;
};

/// All rows; for small answers.
[[nodiscard]] base::Result<std::vector<Row>> rows_of(Database& database, std::string const& statement,
                                                     Row const& values = {});
/// The first column of the only row; null without one.
[[nodiscard]] base::Result<Value> value_of(Database& database, std::string const& statement, Row const& values = {});

}  // namespace lapwing::map::sql
