/// A disk in memory under SQLite, which notes every write and every sync, may be full, and can be brought to
/// any state in which a loss of power might have left it.
#pragma once

#include <sqlite3.h>

#include <atomic>
#include <cstring>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace lockstep::test {

/// Names of files and what is in them.
using DiskContent = std::map<std::string, std::string>;

/// What was done to a disk, in its order.
struct DiskOperation {
  enum Kind { write, truncate, sync, remove } kind;
  std::string file;
  std::size_t offset = 0;  ///< of a write; the length after a truncation
  std::string data;
  bool durable = false;  ///< a removal of which the directory was synced
};

inline void carry_out(DiskContent& content, const DiskOperation& operation) {
  if (operation.kind == DiskOperation::remove) {
    content.erase(operation.file);
    return;
  }
  std::string& file = content[operation.file];
  if (operation.kind == DiskOperation::truncate) file.resize(operation.offset);
  if (operation.kind != DiskOperation::write) return;
  if (file.size() < operation.offset + operation.data.size())
    file.resize(operation.offset + operation.data.size());
  file.replace(operation.offset, operation.data.size(), operation.data);
}

/// Registered with SQLite under `name()` for its life.
class MemoryDisk {
 public:
  explicit MemoryDisk(DiskContent start = {})
      : content(std::move(start)), name_("memory_disk_" + std::to_string(++made())) {
    const sqlite3_vfs* const usual = sqlite3_vfs_find(nullptr);
    vfs_ = *usual;
    vfs_.iVersion = 1;
    vfs_.szOsFile = sizeof(File);
    vfs_.mxPathname = 512;
    vfs_.pNext = nullptr;
    vfs_.zName = name_.c_str();
    vfs_.pAppData = this;
    vfs_.xOpen = &open;
    vfs_.xDelete = &remove;
    vfs_.xAccess = &access;
    vfs_.xFullPathname = &full_path;
    // The rest, which knows no files, is the usual one; its data are its own.
    vfs_.xRandomness = [](sqlite3_vfs*, int size, char* out) {
      sqlite3_vfs* const real = sqlite3_vfs_find(nullptr);
      return real->xRandomness(real, size, out);
    };
    vfs_.xSleep = [](sqlite3_vfs*, int time) { return time; };
    vfs_.xGetLastError = [](sqlite3_vfs*, int, char*) { return 0; };
    sqlite3_vfs_register(&vfs_, 0);
  }
  ~MemoryDisk() { sqlite3_vfs_unregister(&vfs_); }
  MemoryDisk(const MemoryDisk&) = delete;
  MemoryDisk& operator=(const MemoryDisk&) = delete;

  const char* name() const { return name_.c_str(); }

  DiskContent content;
  std::vector<DiskOperation> operations;
  bool recording = false;
  std::atomic<std::size_t> space =
      SIZE_MAX;           ///< of all files together [byte]; changed while another thread writes
  std::string spoiled{};  ///< a text of which the disk keeps '#' in place of its last character
  bool broken = false;    ///< every write and sync fails with an input/output error

 private:
  struct File {
    sqlite3_file base;
    MemoryDisk* disk;
    std::string* name;
  };
  static int& made() {
    static int count = 0;
    return count;
  }
  static File* of(sqlite3_file* file) { return reinterpret_cast<File*>(file); }
  static MemoryDisk* of(sqlite3_vfs* vfs) { return static_cast<MemoryDisk*>(vfs->pAppData); }

  void note(DiskOperation operation) {
    carry_out(content, operation);
    if (recording) operations.push_back(std::move(operation));
  }
  std::size_t used() const {
    std::size_t size = 0;
    for (const auto& [name, text] : content) size += text.size();
    return size;
  }

  static int open(sqlite3_vfs* vfs, const char* path, sqlite3_file* file, int flags, int* out_flags) {
    File* const opened = of(file);
    opened->disk = of(vfs);
    opened->base.pMethods = nullptr;
    const std::string name = path == nullptr ? "temporary" : path;
    if ((flags & SQLITE_OPEN_CREATE) == 0 && !opened->disk->content.contains(name)) return SQLITE_CANTOPEN;
    opened->disk->content.try_emplace(name);
    opened->name = new std::string(name);
    opened->base.pMethods = methods();
    if (out_flags != nullptr) *out_flags = flags;
    return SQLITE_OK;
  }
  static int remove(sqlite3_vfs* vfs, const char* path, int sync_directory) {
    if (!of(vfs)->content.contains(path)) return SQLITE_IOERR_DELETE_NOENT;
    of(vfs)->note({DiskOperation::remove, path, 0, "", sync_directory != 0});
    return SQLITE_OK;
  }
  static int access(sqlite3_vfs* vfs, const char* path, int, int* result) {
    *result = of(vfs)->content.contains(path) ? 1 : 0;
    return SQLITE_OK;
  }
  static int full_path(sqlite3_vfs*, const char* path, int size, char* out) {
    sqlite3_snprintf(size, out, "%s", path);
    return SQLITE_OK;
  }

  static const sqlite3_io_methods* methods() {
    static const sqlite3_io_methods kMethods = [] {
      sqlite3_io_methods made{};
      made.iVersion = 1;
      made.xClose = [](sqlite3_file* file) {
        delete of(file)->name;
        return SQLITE_OK;
      };
      made.xRead = &read;
      made.xWrite = &write;
      made.xTruncate = [](sqlite3_file* file, sqlite3_int64 size) {
        if (of(file)->disk->broken) return SQLITE_IOERR_TRUNCATE;
        of(file)->disk->note({DiskOperation::truncate, *of(file)->name, static_cast<std::size_t>(size), ""});
        return SQLITE_OK;
      };
      made.xSync = [](sqlite3_file* file, int) {
        if (of(file)->disk->broken) return SQLITE_IOERR_FSYNC;
        of(file)->disk->note({DiskOperation::sync, *of(file)->name, 0, ""});
        return SQLITE_OK;
      };
      made.xFileSize = [](sqlite3_file* file, sqlite3_int64* size) {
        *size = static_cast<sqlite3_int64>(of(file)->disk->content[*of(file)->name].size());
        return SQLITE_OK;
      };
      made.xLock = [](sqlite3_file*, int) { return SQLITE_OK; };
      made.xUnlock = [](sqlite3_file*, int) { return SQLITE_OK; };
      made.xCheckReservedLock = [](sqlite3_file*, int* result) {
        *result = 0;
        return SQLITE_OK;
      };
      made.xFileControl = [](sqlite3_file*, int, void*) { return SQLITE_NOTFOUND; };
      made.xSectorSize = [](sqlite3_file*) { return 4096; };
      made.xDeviceCharacteristics = [](sqlite3_file*) { return 0; };
      return made;
    }();
    return &kMethods;
  }
  static int read(sqlite3_file* file, void* out, int size, sqlite3_int64 offset) {
    const std::string& text = of(file)->disk->content[*of(file)->name];
    const auto begin = std::min(static_cast<std::size_t>(offset), text.size());
    const auto count = std::min(static_cast<std::size_t>(size), text.size() - begin);
    std::memcpy(out, text.data() + begin, count);
    if (count == static_cast<std::size_t>(size)) return SQLITE_OK;
    std::memset(static_cast<char*>(out) + count, 0, static_cast<std::size_t>(size) - count);
    return SQLITE_IOERR_SHORT_READ;
  }
  static int write(sqlite3_file* file, const void* data, int size, sqlite3_int64 offset) {
    MemoryDisk& disk = *of(file)->disk;
    if (disk.broken) return SQLITE_IOERR_WRITE;
    const std::size_t end = static_cast<std::size_t>(offset) + static_cast<std::size_t>(size);
    const std::size_t present = disk.content[*of(file)->name].size();
    if (end > present && disk.used() + (end - present) > disk.space) return SQLITE_FULL;
    std::string kept(static_cast<const char*>(data), static_cast<std::size_t>(size));
    if (const std::size_t at = kept.find(disk.spoiled); !disk.spoiled.empty() && at != kept.npos)
      kept[at + disk.spoiled.size() - 1] = '#';
    disk.note({DiskOperation::write, *of(file)->name, static_cast<std::size_t>(offset), std::move(kept)});
    return SQLITE_OK;
  }

  std::string name_;
  sqlite3_vfs vfs_{};
};

/// What may be lost of the first `count` operations: those on a file after its last sync. By index.
inline std::vector<std::size_t> unsynced(const std::vector<DiskOperation>& operations, std::size_t count) {
  std::vector<std::size_t> lost;
  for (std::size_t i = 0; i < count; ++i) {
    const DiskOperation& operation = operations[i];
    if (operation.kind == DiskOperation::sync)
      std::erase_if(lost, [&](std::size_t j) {
        return operations[j].file == operation.file && operations[j].kind != DiskOperation::remove;
      });
    else if (operation.kind != DiskOperation::remove || !operation.durable)
      lost.push_back(i);
  }
  return lost;
}

/// The disk after the first `count` operations without those that were lost. Of a write of which only a part
/// is lost, the second half is.
inline DiskContent disk_after(const DiskContent& start, const std::vector<DiskOperation>& operations,
                              std::size_t count, const std::vector<std::size_t>& lost, bool torn = false) {
  DiskContent content = start;
  for (std::size_t i = 0, next = 0; i < count; ++i) {
    const bool gone = next < lost.size() && lost[next] == i;
    if (gone) ++next;
    DiskOperation operation = operations[i];
    if (gone && (!torn || operation.kind != DiskOperation::write)) continue;
    if (gone) operation.data.resize(operation.data.size() / 2);
    carry_out(content, operation);
  }
  return content;
}

}  // namespace lockstep::test
