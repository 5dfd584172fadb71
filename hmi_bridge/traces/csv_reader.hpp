/// Reads traces from comma-separated values.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "hmi_bridge/traces/table.hpp"

namespace lockstep {

/// Reads a file that `CsvTrace` wrote, or one like it. The columns have no types there: all are LREAL.
/// A last line without its end is left out, with a remark.
/// @throws TraceFormatError "FILE:line:column: …" for what is not a number, a line with more or fewer values
/// than
///     names, a first column that is not `t`, a line of more than 16 MiB; "FILE: …" if it cannot be read, or
///     is no regular file
/// @param progress is called now and then with what part of it has been read, from 0 to 1; what it throws
///     ends the reading
TraceTable read_csv_trace(const std::string& path, const std::function<void(double)>& progress = {});

/// `read_csv_trace` from a text in memory; `name` stands for the file in messages.
TraceTable parse_csv_trace(std::string_view text, const std::string& name);

}  // namespace lockstep
