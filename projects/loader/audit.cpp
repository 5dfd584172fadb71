// The audit log of a project.
#include "projects/keys/project.hpp"
#include "projects/loader/loader.hpp"
#include "projects/loader/read_keys.hpp"

namespace lockstep {

void load_audit(const JsonValue& json, const Loading& loading) {
  AuditOptions options;
  if (read_struct(json, keys::kAudit, options, loading).usable()) loading.project.audit = std::move(options);
}

}  // namespace lockstep
