// The audit log of a project.
#include "projects/loader/loader.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t kSmallest = 4096, kLargest = std::int64_t{1} << 40;  // of a file [byte]

}  // namespace

void load_audit(const JsonValue& json, const Loading& loading) {
  Problems& problems = loading.problems;
  const Fields fields(json, keys::kAudit, problems);
  if (!fields.usable()) return;
  AuditOptions options;
  if (const auto file = read_title(fields["file"], problems)) options.file = *file;
  if (const auto size = read_integer(fields["size"], kSmallest, kLargest, problems)) options.size = *size;
  if (const auto files = read_integer(fields["files"], 2, 1000, problems))
    options.files = static_cast<int>(*files);
  loading.project.audit = std::move(options);
}

}  // namespace lockstep
