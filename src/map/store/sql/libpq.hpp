#pragma once

#include <string>

#include <libpq-fe.h>

namespace lapwing::map::sql {

/// PostgreSQL's client library, loaded when the first store on a server is opened. It brings eighteen others for ways
/// to log in, which would double the time that every program with a store takes to start, most of which keep theirs in
/// a file.
struct Libpq {
  std::string problem;  ///< why it could not be loaded; empty when it was

  decltype(&PQclear) clear;
  decltype(&PQcmdStatus) command_status;
  decltype(&PQcmdTuples) changed_rows;
  decltype(&PQconnectdbParams) connect;
  decltype(&PQdescribePrepared) describe_prepared;
  decltype(&PQenterPipelineMode) enter_pipeline;
  decltype(&PQerrorMessage) error_message;
  decltype(&PQexec) execute;
  decltype(&PQexecPrepared) execute_prepared;
  decltype(&PQexitPipelineMode) exit_pipeline;
  decltype(&PQfinish) finish;
  decltype(&PQftype) type_of_column;
  decltype(&PQgetResult) next_result;
  decltype(&PQgetisnull) is_null;
  decltype(&PQgetlength) length;
  decltype(&PQgetvalue) value;
  decltype(&PQnfields) columns;
  decltype(&PQnparams) parameters;
  decltype(&PQntuples) rows;
  decltype(&PQpipelineSync) sync_pipeline;
  decltype(&PQprepare) prepare;
  decltype(&PQreset) reset;
  decltype(&PQresultErrorField) error_field;
  decltype(&PQresultErrorMessage) result_message;
  decltype(&PQresultStatus) result_status;
  decltype(&PQsendQueryPrepared) send_prepared;
  decltype(&PQsetNoticeProcessor) set_notice_processor;
  decltype(&PQstatus) status;
};

/// The same each time, on any thread. Its functions may be called when it has no problem.
[[nodiscard]] Libpq const& libpq();

}  // namespace lapwing::map::sql
