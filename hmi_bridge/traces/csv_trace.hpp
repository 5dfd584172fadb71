/// Traces as comma-separated values.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "hmi_bridge/traces/file.hpp"
#include "hmi_bridge/traces/sink.hpp"

namespace lockstep {

/// Writes a trace to a file: first line `t,` and the names, then one line for each row, `t` in seconds,
/// numbers as `print_value` has them, lines end with "\n".
class CsvTrace final : public TraceSink {
 public:
  /// What is done with a file that is there already.
  enum class Open : std::uint8_t {
    over,     ///< it is cut to nothing
    new_file  ///< that is an error (EEXIST)
  };
  /// Opens the file. Any thread.
  /// @throws std::system_error if that fails; its text names the file
  explicit CsvTrace(const std::string& path, Open how = Open::over);
  ~CsvTrace() override;

  void begin(std::span<const TraceSignal> signals) override;
  void row(const TraceRow& row) override;
  void flush() override;
  void end() override;
  std::string_view name() const noexcept override { return path_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };
  void write(std::size_t bytes, std::uint64_t rows);

  const std::string path_;
  const std::unique_ptr<std::FILE, Close> stream_;
  TraceFile file_;
  std::vector<Type> types_;
  std::vector<char> line_;
};

}  // namespace lockstep
