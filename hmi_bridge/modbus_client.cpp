#include "hmi_bridge/modbus_client.hpp"

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <csignal>
#include <tuple>
#include <utility>

namespace lockstep {
namespace {

/// The thread that starts the client may be one of the cycle's: nothing of its priority is passed on.
void step_back() noexcept {
  const sched_param ordinary{};
  ::pthread_setschedparam(::pthread_self(), SCHED_OTHER, &ordinary);
  ::pthread_setname_np(::pthread_self(), "modbus_client");
}

}  // namespace

std::string ModbusClientOptions::place() const {
  return connect ? to_string(*connect) : serial.device;
}

ModbusClient::ModbusClient(ModbusClientOptions options, ProcessImage& image)
    : options_(std::move(options)), image_(image), words_(kMostBitsRead) {
  for (const ModbusDevice& device : options_.devices)
    devices_.push_back({.options = &device,
                        .reads = blocks_of(device.reads, kMostRegistersRead, kMostBitsRead),
                        .writes = blocks_of(device.writes, kMostRegistersWritten, kMostBitsWritten)});
  master_ = options_.connect ? std::make_unique<ModbusMaster>(*options_.connect, options_.timeout)
                             : std::make_unique<ModbusMaster>(options_.serial, options_.timeout);
}

ModbusClient::~ModbusClient() {
  stop();
}

/// Neighbours go into one request. A gap ends it: devices refuse addresses that they do not have.
std::vector<ModbusClient::Block> ModbusClient::blocks_of(std::vector<ModbusEntry> entries,
                                                         std::uint32_t most_registers,
                                                         std::uint32_t most_bits) {
  std::stable_sort(entries.begin(), entries.end(), [](const ModbusEntry& a, const ModbusEntry& b) {
    return std::tie(a.table, a.address) < std::tie(b.table, b.address);
  });
  std::vector<Block> blocks;
  for (const ModbusEntry& entry : entries) {
    const std::uint32_t most = is_bit_table(entry.table) ? most_bits : most_registers;
    const std::uint32_t end = entry.address + modbus_span(entry);
    // Bits of one register stand at the same address.
    const bool goes_on = !blocks.empty() && blocks.back().table == entry.table &&
                         entry.address <= blocks.back().address + blocks.back().count &&
                         end - blocks.back().address <= most;
    if (!goes_on) blocks.push_back({entry.table, entry.address, 0, {}});
    Block& block = blocks.back();
    block.count = std::max(block.count, end - block.address);
    block.entries.push_back(entry);
  }
  return blocks;
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
  step_back();
  const Clock::time_point begin = Clock::now();
  for (Device& device : devices_) device.next = device.last_good = begin;
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
  retry.pause =
      retry.pause.count() == 0 ? options_.first_retry : std::min(2 * retry.pause, options_.longest_retry);
  retry.at = now + retry.pause;
}

/// One cycle of a device. An exception spoils the cycle and not what else it does; silence ends it.
bool ModbusClient::exchange(Device& device) {
  bool is_good = true;
  image_.refresh();  // the one instant that goes out
  for (const Block& block : device.writes) {
    if (!master_->is_connected()) return false;
    is_good &= write_block(device, block);
  }
  for (const Block& block : device.reads) {
    if (!master_->is_connected()) return false;
    is_good &= read_block(device, block);
  }
  return is_good && master_->is_connected();
}

bool ModbusClient::count(bool is_good) {
  if (is_good)
    ++counters_.requests;
  else
    ++(master_->was_refused() ? counters_.refused : counters_.failed);
  return is_good;
}

bool ModbusClient::read_block(const Device& device, const Block& block) {
  const auto words = std::span(words_).first(block.count);
  if (!count(master_->read(device.options->unit, block.table, block.address, words))) return false;
  bool is_good = true;
  for (const ModbusEntry& entry : block.entries) {
    const auto own = words.subspan(entry.address - block.address, modbus_span(entry));
    if (const auto value = decode(entry, image_.type(entry.signal), own)) {
      batch_.push_back({entry.signal, *value});
    } else {
      ++counters_.bad_values;
      is_good = false;
    }
  }
  return is_good;
}

bool ModbusClient::write_block(const Device& device, const Block& block) {
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
void ModbusClient::show(const Device& device, bool is_good, Clock::time_point now) {
  Value value{};
  value.u = is_good ? 1 : 0;
  if (device.options->quality) batch_.push_back({*device.options->quality, value});
  value.i = std::chrono::nanoseconds(now - device.last_good).count();
  if (device.options->age) batch_.push_back({*device.options->age, value});
  if (!batch_.empty()) image_.post(batch_);
}

}  // namespace lockstep
