# lapwing_dialect: the C++11 MAVLink headers, made by mavgen from pymavlink's own dialect XML (ardupilotmega: all of common).
#
# A system include, since generated code does not answer to our warnings. Only src/mavlink/*.cpp and tests may use it.
set(LAPWING_PYTHON ${CMAKE_SOURCE_DIR}/.venv/bin/python CACHE FILEPATH "Python that has pymavlink (./lapwing makes it)")
set(DIALECT_DIR ${CMAKE_BINARY_DIR}/dialect)
set(DIALECT_STAMP ${DIALECT_DIR}/generated.stamp)

add_custom_command(
  OUTPUT ${DIALECT_STAMP}
  COMMAND ${LAPWING_PYTHON} ${CMAKE_SOURCE_DIR}/cmake/generate_dialect.py ardupilotmega ${DIALECT_DIR}
  COMMAND ${CMAKE_COMMAND} -E touch ${DIALECT_STAMP}
  DEPENDS ${CMAKE_SOURCE_DIR}/cmake/generate_dialect.py
  COMMENT "Generating MAVLink headers (ardupilotmega)"
  VERBATIM)
# Names of messages, fields and enumerations, for messages that people write by hand.
set(DIALECT_TABLES ${DIALECT_DIR}/tables)
set(DIALECT_TABLE_FILES
  ${DIALECT_TABLES}/dialect_messages.inc ${DIALECT_TABLES}/dialect_fields.inc ${DIALECT_TABLES}/dialect_names.inc
  ${DIALECT_TABLES}/dialect_instances.inc)
add_custom_command(
  OUTPUT ${DIALECT_TABLE_FILES}
  COMMAND ${LAPWING_PYTHON} ${CMAKE_SOURCE_DIR}/cmake/generate_message_tables.py ardupilotmega ${DIALECT_TABLES}
  DEPENDS ${CMAKE_SOURCE_DIR}/cmake/generate_message_tables.py
  COMMENT "Generating tables of MAVLink names (ardupilotmega)"
  VERBATIM)
add_custom_target(lapwing_dialect_headers DEPENDS ${DIALECT_STAMP} ${DIALECT_TABLE_FILES})

add_library(lapwing_dialect INTERFACE)
add_dependencies(lapwing_dialect lapwing_dialect_headers)
target_include_directories(lapwing_dialect SYSTEM INTERFACE ${DIALECT_DIR}/cpp11 ${DIALECT_DIR})
