// Drives a fuzz target with seeded random changes of its seeds: the same inputs on every machine, no compiler
// but g++. fuzz_targets TARGET [NUMBER]; a single input: fuzz_targets TARGET --input FILE; seeds and corpus,
// to begin with: fuzz_targets TARGET --seeds FOLDER.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string_view>

#include "tests/fuzz/fuzz_target.hpp"
#include "tests/support/seeds.hpp"

namespace lockstep::fuzz {
namespace {

constexpr std::size_t kLongest = 1 << 16;
// For one input, also under a sanitizer [s]: of the processor, and in all where it waits for something. On a
// machine that does much else a minute may pass without this process.
constexpr unsigned kPatience = 60, kWholePatience = 900;

constexpr std::string_view kPieces[] = {"\"",
                                        "{",
                                        "}",
                                        "[",
                                        "]",
                                        ",",
                                        ":",
                                        "-",
                                        "1e999",
                                        "0.5",
                                        "null",
                                        "true",
                                        "\\u0000",
                                        "\\ud800",
                                        "\"\"",
                                        "T#1s",
                                        "16#",
                                        "(*",
                                        "AND",
                                        "NOT",
                                        "(",
                                        ")",
                                        "\xff",
                                        "\n",
                                        "nan",
                                        "inf",
                                        "1e308",
                                        "-0",
                                        "\x00",
                                        "\x7f\xff",
                                        "99999999999999999999",
                                        "\r\n"};

/// Makes inputs out of the seeds.
class Mutator {
 public:
  Mutator(std::vector<std::string> seeds, std::uint64_t seed) : seeds_(std::move(seeds)), random_(seed) {}

  std::string next() {
    std::string text = seeds_[below(seeds_.size())];
    const std::size_t times = below(8);
    for (std::size_t i = 0; i < times; ++i) change(text);
    if (text.size() > kLongest) text.resize(kLongest);
    return text;
  }

 private:
  std::size_t below(std::size_t end) {
    return std::uniform_int_distribution<std::size_t>(0, end - 1)(random_);
  }

  void change(std::string& text) {
    const std::size_t at = below(text.size() + 1);
    const std::size_t length = std::min(text.size() - at, 1 + below(48));
    const std::string& other = seeds_[below(seeds_.size())];
    switch (below(9)) {
      case 0:
        if (at < text.size()) text[at] = static_cast<char>(below(256));
        break;
      case 1:
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(below(text.size() + 1), text.substr(at, length));
        break;
      case 4:
        text.insert(at, kPieces[below(std::size(kPieces))]);
        break;
      case 5:
        text.resize(at);
        break;
      case 6:  // a part of a seed
        if (!other.empty()) text.replace(at, length, other.substr(below(other.size()), 1 + below(64)));
        break;
      case 7:  // the end of a seed
        if (!other.empty()) text.replace(at, std::string::npos, other.substr(below(other.size())));
        break;
      default:
        if (at < text.size()) text.replace(at, 1, std::to_string(static_cast<std::int64_t>(random_())));
    }
  }

  std::vector<std::string> seeds_;
  std::mt19937_64 random_;
};

/// Where the input stands that is being looked at, so that it is there when the program is not.
class Witness {
 public:
  explicit Witness(const std::string& path) : path_(path) {
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (file < 0 || ::ftruncate(file, kLongest + 8) != 0) return;
    void* const memory = ::mmap(nullptr, kLongest + 8, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    ::close(file);
    if (memory != MAP_FAILED) memory_ = static_cast<char*>(memory);
  }
  ~Witness() { ::unlink(path_.c_str()); }
  Witness(const Witness&) = delete;
  Witness& operator=(const Witness&) = delete;
  void note(const std::string& input) {
    if (memory_ == nullptr) return;
    const std::uint64_t size = input.size();
    std::memcpy(memory_, &size, 8);
    std::memcpy(memory_ + 8, input.data(), input.size());
  }

 private:
  std::string path_;
  char* memory_ = nullptr;
};

/// The process ends when one input takes longer.
void watch() {
  const itimerval processor{{0, 0}, {kPatience, 0}};
  ::setitimer(ITIMER_PROF, &processor, nullptr);
  ::alarm(kWholePatience);
}
void watch_no_more() {
  const itimerval none{};
  ::setitimer(ITIMER_PROF, &none, nullptr);
  ::alarm(0);
}

void look_at(const Target& target, const std::string& input) {
  // A copy of exactly this size, so that reading beyond its end is seen.
  const std::vector<std::uint8_t> bytes(input.begin(), input.end());
  target.take(bytes.data(), bytes.size());
}

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What has been found once, in files of tests/fuzz/corpus; there need not be any.
std::vector<std::string> corpus(const Target& target) {
  std::vector<std::filesystem::path> paths;
  std::error_code none;
  const std::filesystem::path folder = std::filesystem::path(LOCKSTEP_CORPUS) / target.name;
  for (const auto& file : std::filesystem::directory_iterator(folder, none)) paths.push_back(file.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> inputs;
  for (const auto& path : paths) inputs.push_back(content(path));
  return inputs;
}

int look_at_file(const Target& target, const char* path) {
  std::string input = content(path);
  if (std::string_view(path).ends_with(".witness") && input.size() >= 8) {
    std::uint64_t size = 0;
    std::memcpy(&size, input.data(), 8);
    input = input.substr(8, size);
  }
  look_at(target, input);
  return 0;
}

int write_seeds(const Target& target, const std::string& folder) {
  int number = 0;
  for (const std::string& seed : target.seeds())
    std::ofstream(folder + "/seed_" + std::to_string(++number), std::ios::binary) << seed;
  for (const std::string& found : corpus(target))
    std::ofstream(folder + "/found_" + std::to_string(++number), std::ios::binary) << found;
  return 0;
}

int run(const Target& target, const char* program, int inputs) {
  const std::string witness = std::string(program) + "_" + std::string(target.name) + ".witness";
  std::cout << "if it ends early: " << program << " " << target.name << " --input " << witness << std::endl;
  Mutator mutator(target.seeds(), test::seed_of_run(20260714));
  Witness place(witness);
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < inputs; ++i) {
    const std::string input = mutator.next();
    place.note(input);
    watch();
    look_at(target, input);
  }
  watch_no_more();
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  std::cout << inputs << " inputs, " << spent.count() << " s" << std::endl;
  return 0;
}

int drive(const Target& target, int argc, char** argv) {
  const std::string_view first = argc > 2 ? argv[2] : "";
  if (first == "--input" && argc > 3) return look_at_file(target, argv[3]);
  if (first == "--seeds" && argc > 3) return write_seeds(target, argv[3]);
  for (const std::string& seed : target.seeds()) look_at(target, seed);
  for (const std::string& found : corpus(target)) {
    watch();
    look_at(target, found);
  }
  const int inputs = argc > 2 ? std::atoi(argv[2]) : 1000;
  return run(target, argv[0], test::cases(inputs, 100 * inputs));
}

}  // namespace
}  // namespace lockstep::fuzz

int main(int argc, char** argv) {
  const std::string_view name = argc > 1 ? argv[1] : "";
  for (const lockstep::fuzz::Target& target : lockstep::fuzz::targets())
    if (target.name == name) return lockstep::fuzz::drive(target, argc, argv);
  std::cerr << "fuzz_targets TARGET [NUMBER], of which TARGET is one of" << std::endl;
  for (const lockstep::fuzz::Target& target : lockstep::fuzz::targets())
    std::cerr << target.name << std::endl;
  return 2;
}
