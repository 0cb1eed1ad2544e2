#include "map/store/sql/libpq.hpp"

#include <dlfcn.h>

namespace lapwing::map::sql {

namespace {

template <class Function>
void find(void* library, char const* name, Function*& function, std::string& problem) {
  function = reinterpret_cast<Function*>(::dlsym(library, name));
  if (function == nullptr && problem.empty()) problem = std::string("libpq.so.5 has no ") + name;
}

Libpq load() {
  Libpq pq{};
  // Kept to the end of the program, as a library that is linked would be.
  void* const library = ::dlopen("libpq.so.5", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    char const* const why = ::dlerror();
    pq.problem = why ? why : "libpq.so.5 cannot be loaded";
    return pq;
  }
  find(library, "PQclear", pq.clear, pq.problem);
  find(library, "PQcmdStatus", pq.command_status, pq.problem);
  find(library, "PQcmdTuples", pq.changed_rows, pq.problem);
  find(library, "PQconnectdbParams", pq.connect, pq.problem);
  find(library, "PQdescribePrepared", pq.describe_prepared, pq.problem);
  find(library, "PQenterPipelineMode", pq.enter_pipeline, pq.problem);
  find(library, "PQerrorMessage", pq.error_message, pq.problem);
  find(library, "PQexec", pq.execute, pq.problem);
  find(library, "PQexecPrepared", pq.execute_prepared, pq.problem);
  find(library, "PQexitPipelineMode", pq.exit_pipeline, pq.problem);
  find(library, "PQfinish", pq.finish, pq.problem);
  find(library, "PQftype", pq.type_of_column, pq.problem);
  find(library, "PQgetResult", pq.next_result, pq.problem);
  find(library, "PQgetisnull", pq.is_null, pq.problem);
  find(library, "PQgetlength", pq.length, pq.problem);
  find(library, "PQgetvalue", pq.value, pq.problem);
  find(library, "PQnfields", pq.columns, pq.problem);
  find(library, "PQnparams", pq.parameters, pq.problem);
  find(library, "PQntuples", pq.rows, pq.problem);
  find(library, "PQpipelineSync", pq.sync_pipeline, pq.problem);
  find(library, "PQprepare", pq.prepare, pq.problem);
  find(library, "PQreset", pq.reset, pq.problem);
  find(library, "PQresultErrorField", pq.error_field, pq.problem);
  find(library, "PQresultErrorMessage", pq.result_message, pq.problem);
  find(library, "PQresultStatus", pq.result_status, pq.problem);
  find(library, "PQsendQueryPrepared", pq.send_prepared, pq.problem);
  find(library, "PQsetNoticeProcessor", pq.set_notice_processor, pq.problem);
  find(library, "PQstatus", pq.status, pq.problem);
  return pq;
}

}  // namespace

Libpq const& libpq() {
  static Libpq const loaded = load();
  return loaded;
}

}  // namespace lapwing::map::sql
