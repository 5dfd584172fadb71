// Any trace as comma-separated values, as lockstep plot reads it.
#include "hmi_bridge/traces/csv_reader.hpp"
#include "tests/fuzz/texts.hpp"

namespace lockstep::fuzz::csv_target {

std::vector<std::string> seeds() {
  return {"t,a,b\n0,1,2\n0.001,1.5,-2e3\n", "t,a\r\n0,nan\r\n1e-3,inf\r\n2e-3,0", "t\n1\n"};
}

int take(const std::uint8_t* data, std::size_t size) {
  try {
    const TraceTable table = parse_csv_trace(text_of(data, size), "FILE");
    require(table.columns.size() == table.signals.size(), "a column for each signal");
    for (const auto& column : table.columns)
      require(column.size() == table.t.size(), "columns of one length");
  } catch (const TraceFormatError& error) {
    require(std::string_view(error.what()).starts_with("FILE"), "an error names its file");
  }
  return 0;
}

}  // namespace lockstep::fuzz::csv_target
