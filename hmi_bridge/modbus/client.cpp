#include "hmi_bridge/modbus/client.hpp"

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <csignal>
#include <tuple>
#include <utility>

namespace lockstep {
namespace {

constexpr int kCyclesApart = 100;  // for which lines are asked for alone after a refusal

/// The thread that starts the client may be one of the cycle's: nothing of its priority is passed on.
void leave_cycle_priority() noexcept {
  const sched_param ordinary{};
  ::pthread_setschedparam(::pthread_self(), SCHED_OTHER, &ordinary);
  ::pthread_setname_np(::pthread_self(), "modbus_client");
}

/// Entries whose line nobody has said are lines of their own.
std::vector<ModbusEntry> numbered(std::vector<ModbusEntry> entries) {
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (entries[i].line == ModbusEntry::kOwnLine) entries[i].line = static_cast<std::uint32_t>(i);
  return entries;
}

std::size_t lines_of(const std::vector<ModbusEntry>& entries) {
  std::size_t count = 0;
  for (const ModbusEntry& entry : entries) count = std::max(count, entry.line + std::size_t{1});
  return count;
}

}  // namespace

std::string ModbusClientOptions::endpoint() const {
  return connect ? to_string(*connect) : serial.device;
}

ModbusClient::ModbusClient(ModbusClientOptions options, ProcessImage& image)
    : options_(std::move(options)), image_(image), words_(kMaximumBitsRead) {
  for (const ModbusDevice& device : options_.devices) {
    devices_.push_back({.options = &device, .reads = {}, .writes = {}});
    make_blocks(devices_.back());
  }
  master_ = options_.connect ? std::make_unique<ModbusMaster>(*options_.connect, options_.timeout)
                             : std::make_unique<ModbusMaster>(options_.serial, options_.timeout);
}

ModbusClient::~ModbusClient() {
  stop();
}

/// Neighbours go into one request. A gap ends it: devices refuse addresses that they do not have.
std::vector<ModbusClient::Block> ModbusClient::blocks_of(std::vector<ModbusEntry> entries,
                                                         std::uint32_t maximum_registers,
                                                         std::uint32_t maximum_bits) {
  std::stable_sort(entries.begin(), entries.end(), [](const ModbusEntry& a, const ModbusEntry& b) {
    return std::tie(a.table, a.address) < std::tie(b.table, b.address);
  });
  std::vector<Block> blocks;
  for (const ModbusEntry& entry : entries) {
    const std::uint32_t maximum = is_bit_table(entry.table) ? maximum_bits : maximum_registers;
    const std::uint32_t end = entry.address + modbus_span(entry);
    // Bits of one register stand at the same address.
    const bool goes_on = !blocks.empty() && blocks.back().table == entry.table &&
                         entry.address <= blocks.back().address + blocks.back().count &&
                         end - blocks.back().address <= maximum;
    if (!goes_on) blocks.push_back({entry.table, entry.address, 0, {}});
    Block& block = blocks.back();
    block.count = std::max(block.count, end - block.address);
    block.entries.push_back(entry);
  }
  return blocks;
}

/// Everything together as far as it may go; what is known of the lines stays.
void ModbusClient::make_blocks(Device& device) const {
  const std::vector<ModbusEntry> reads = numbered(device.options->reads);
  const std::vector<ModbusEntry> writes = numbered(device.options->writes);
  device.lines[0].resize(lines_of(reads));
  device.lines[1].resize(lines_of(writes));
  device.reads = blocks_of(reads, kMaximumRegistersRead, kMaximumBitsRead);
  device.writes = blocks_of(writes, kMaximumRegistersWritten, kMaximumBitsWritten);
  device.cycles_apart = 0;
}

/// A block for each line; lines that share a register stay together.
std::vector<ModbusClient::Block> ModbusClient::parts_of(const Block& block) {
  std::vector<Block> parts;
  for (const ModbusEntry& entry : block.entries) {
    const std::uint32_t end = entry.address + modbus_span(entry);
    const bool goes_on = !parts.empty() && (parts.back().entries.back().line == entry.line ||
                                            entry.address < parts.back().address + parts.back().count);
    if (!goes_on) parts.push_back({entry.table, entry.address, 0, {}});
    Block& part = parts.back();
    part.count = std::max(part.count, end - part.address);
    part.entries.push_back(entry);
  }
  return parts;
}

void ModbusClient::start() {
  if (thread_.joinable()) return;
  is_stopping_ = false;
  sigset_t all;
  sigset_t before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);  // signals are for the thread that waits for them
  thread_ = std::thread([this] { run(); });
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void ModbusClient::stop() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    is_stopping_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

/// False if the client is to end.
bool ModbusClient::wait_until(Clock::time_point time) {
  std::unique_lock lock(mutex_);
  return !wake_.wait_until(lock, time, [this] { return is_stopping_; });
}

void ModbusClient::run() noexcept {
  leave_cycle_priority();
  const Clock::time_point begin = Clock::now();
  for (Device& device : devices_) {
    device.next = device.last_good = begin;
    for (auto& lines : device.lines)
      for (Line& line : lines) line.last_good = begin;
  }
  while (!devices_.empty()) {
    Device& device = *std::min_element(devices_.begin(), devices_.end(),
                                       [](const Device& a, const Device& b) { return a.next < b.next; });
    if (!wait_until(device.next)) break;
    try {
      turn(device);
    } catch (...) {
      ++counters_.faults;
    }
    // The grid of cycles stays; those whose time has passed are left out.
    const Clock::duration cycle = device.options->cycle;
    const Clock::time_point now = Clock::now();
    device.next += cycle;
    if (device.next < now) device.next += (now - device.next + cycle - Clock::duration(1)) / cycle * cycle;
  }
  master_->close();
}

void ModbusClient::turn(Device& device) {
  const Clock::time_point now = Clock::now();
  batch_.clear();
  for (auto& lines : device.lines)
    for (Line& line : lines) line.is_good = false;
  bool is_good = false;
  if (now >= device.retry.at && is_reachable(now)) {
    is_good = exchange(device);
    if (is_good)
      device.retry = {};
    else if (!master_->is_connected())
      put_off(device.retry, Clock::now());
  }
  const Clock::time_point end = Clock::now();
  if (is_good) device.last_good = end;
  show(device, is_good, end);
}

bool ModbusClient::is_reachable(Clock::time_point now) {
  if (master_->is_connected() && !master_->is_cut()) return true;
  master_->close();
  if (now < connection_.at) return false;
  if (master_->connect()) {
    ++counters_.connections;
    connection_ = {};
    return true;
  }
  ++counters_.unreachable;
  put_off(connection_, Clock::now());
  return false;
}

void ModbusClient::put_off(Retry& retry, Clock::time_point now) const {
  // On a line an answer that comes late looks like that of the next request; it is waited for.
  const auto first =
      options_.connect ? options_.first_retry : std::max(options_.first_retry, options_.timeout);
  retry.pause = retry.pause.count() == 0 ? first : std::min(2 * retry.pause, options_.longest_retry);
  retry.at = now + retry.pause;
}

/// One cycle of a device. An exception spoils what it refuses and not what else it does; silence ends it.
bool ModbusClient::exchange(Device& device) {
  if (device.cycles_apart > 0 && --device.cycles_apart == 0) make_blocks(device);
  for (auto& lines : device.lines)
    for (Line& line : lines) line.is_good = true;  // until one of its entries is not
  image_.refresh();                                // the one instant that goes out
  const bool is_written = exchange(device, device.writes, true);
  const bool is_read = exchange(device, device.reads, false);
  return is_written && is_read && master_->is_connected();
}

bool ModbusClient::exchange(Device& device, std::vector<Block>& blocks, bool is_write) {
  bool is_good = true;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Outcome outcome = !master_->is_connected() ? Outcome::failed
                            : is_write               ? write_block(device, blocks[i])
                                                     : read_block(device, blocks[i]);
    if (outcome == Outcome::refused && take_apart(blocks, i)) {
      device.cycles_apart = kCyclesApart;
      --i;  // its parts follow
      continue;
    }
    if (outcome == Outcome::refused || outcome == Outcome::failed)
      for (const ModbusEntry& entry : blocks[i].entries) device.lines[is_write][entry.line].is_good = false;
    is_good &= outcome == Outcome::good;
  }
  return is_good;
}

/// Puts a request for each line in the place of one that was refused; false if it has only one.
bool ModbusClient::take_apart(std::vector<Block>& blocks, std::size_t index) {
  const std::vector<Block> parts = parts_of(blocks[index]);
  if (parts.size() < 2) return false;
  const auto next = blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(index));
  blocks.insert(next, parts.begin(), parts.end());
  return true;
}

ModbusClient::Outcome ModbusClient::count(bool is_good) {
  if (is_good) {
    ++counters_.requests;
    return Outcome::good;
  }
  ++(master_->was_refused() ? counters_.refused : counters_.failed);
  return master_->was_refused() ? Outcome::refused : Outcome::failed;
}

ModbusClient::Outcome ModbusClient::read_block(Device& device, const Block& block) {
  const auto words = std::span(words_).first(block.count);
  Outcome outcome = count(master_->read(device.options->unit, block.table, block.address, words));
  if (outcome != Outcome::good) return outcome;
  for (const ModbusEntry& entry : block.entries) {
    const auto own = words.subspan(entry.address - block.address, modbus_span(entry));
    if (const auto value = decode(entry, image_.type(entry.signal), own)) {
      batch_.push_back({entry.signal, *value});
    } else {
      ++counters_.bad_values;
      device.lines[0][entry.line].is_good = false;
      outcome = Outcome::bad_value;
    }
  }
  return outcome;
}

ModbusClient::Outcome ModbusClient::write_block(const Device& device, const Block& block) {
  const auto words = std::span(words_).first(block.count);
  std::fill(words.begin(), words.end(), std::uint16_t{0});
  for (const ModbusEntry& entry : block.entries) {
    const ModbusWords own = encode(entry, image_.type(entry.signal), image_.value(entry.signal));
    for (std::uint32_t i = 0; i < modbus_span(entry); ++i)
      words[entry.address - block.address + i] |= own[i];  // bits share their register
  }
  return count(master_->write(device.options->unit, block.table, block.address, words));
}

/// What was read enters the signals together with what is known of it.
void ModbusClient::show(Device& device, bool is_good, Clock::time_point now) {
  const auto post = [&](std::optional<std::uint32_t> quality, std::optional<std::uint32_t> age, bool good,
                        Clock::time_point last_good) {
    Value value{};
    value.u = good ? 1 : 0;
    if (quality) batch_.push_back({*quality, value});
    value.i = std::chrono::nanoseconds(now - last_good).count();
    if (age) batch_.push_back({*age, value});
  };
  post(device.options->quality, device.options->age, is_good, device.last_good);
  for (auto& lines : device.lines)
    for (Line& line : lines)
      if (line.is_good) line.last_good = now;
  for (const ModbusLineState& state : device.options->lines) {
    const Line& line = device.lines[state.is_write].at(state.line);
    post(state.quality, state.age, line.is_good, line.last_good);
  }
  if (!batch_.empty()) image_.post(batch_);
}

}  // namespace lockstep
