#include "hmi_bridge/traces/csv_trace.hpp"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "hmi_bridge/traces/csv_number.hpp"

namespace lockstep {
namespace {

std::FILE* open(const std::string& path, CsvTrace::Open how) {
  std::FILE* file = std::fopen(path.c_str(), how == CsvTrace::Open::new_file ? "wbxe" : "wbe");
  if (file == nullptr) throw std::system_error(errno, std::generic_category(), path);
  return file;
}

}  // namespace

CsvTrace::CsvTrace(const std::string& path, Open how)
    : path_(path), stream_(open(path, how)), file_(*this, stream_.get()) {}

CsvTrace::~CsvTrace() {
  file_.close();  // before its buffer goes
}

void CsvTrace::begin(std::span<const TraceSignal> signals) {
  std::string names = "t";
  for (const TraceSignal& signal : signals) {
    types_.push_back(signal.type);
    names += ',' + signal.name;
  }
  names += '\n';
  line_.resize(std::max(names.size(), (signals.size() + 1) * (kNumberLength + 1)));
  std::copy(names.begin(), names.end(), line_.begin());
  write(names.size(), 0);
}

void CsvTrace::row(const TraceRow& row) {
  char* out = print_seconds(line_.data(), row.t);
  for (std::size_t i = 0; i < types_.size(); ++i) {
    *out++ = ',';
    out = print_column_value(out, row.values[i], types_[i]);
  }
  *out++ = '\n';
  write(static_cast<std::size_t>(out - line_.data()), 1);
}

void CsvTrace::write(std::size_t bytes, std::uint64_t rows) {
  if (!file_.open_row(bytes, rows)) return;
  file_.close_row(fwrite_unlocked(line_.data(), 1, bytes, stream_.get()) == bytes);
}

void CsvTrace::flush() {
  file_.flush();
}

void CsvTrace::end() {
  file_.close();
}

}  // namespace lockstep
