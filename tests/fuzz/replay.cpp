// Runs a fuzz target over files, folders and its generated seeds, each as it is and mutated:
//
//   x_fuzz [--mutations N] [--max-bytes N] [--out FOLDER] [FILE | FOLDER]…
//   x_fuzz --write-seeds FOLDER
//
// Mutations depend on nothing but the files, so a failure comes again. Each file runs in a process
// of its own: a crash, a sanitizer's report or a hang is told with the number of the mutation, and
// the other files still run. Larger files than --max-bytes (default 64 KiB) are left out.

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/mutate.h"

namespace {

using namespace pstrips;
namespace fs = std::filesystem;

constexpr unsigned kSecondsAnInput = 20;  // sanitizers included

struct Options {
  std::uint32_t mutations = 100;
  std::uintmax_t max_bytes = 65536;
  fs::path out, seeds;
  std::vector<fs::path> paths;
};

struct Seed {
  std::string name;
  Bytes bytes;
};

Bytes load(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  return fuzz::copy(text);
}

void save(const fs::path& path, ByteView bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

std::vector<fs::path> files_below(const fs::path& path, const fuzz::Target& target) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> out;
  for (const auto& entry : fs::recursive_directory_iterator(path)) {
    const std::string extension = entry.path().extension().string();
    if (entry.is_regular_file() && std::ranges::count(target.extensions, extension) != 0)
      out.push_back(entry.path());
  }
  std::ranges::sort(out);
  return out;
}

std::vector<Seed> collect(const Options& options, const fuzz::Target& target) {
  std::vector<Seed> out;
  for (const Bytes& bytes : target.seeds)
    out.push_back({"generated " + std::to_string(out.size()), bytes});
  for (const fs::path& path : options.paths)
    for (const fs::path& file : files_below(path, target))
      if (fs::file_size(file) <= options.max_bytes) out.push_back({file.string(), load(file)});
  return out;
}

Bytes input_of(const Seed& seed, std::uint32_t mutation, const fuzz::Target& target,
               std::span<const Bytes> others) {
  if (mutation == 0) return seed.bytes;
  std::uint32_t hash = 2166136261u;  // FNV-1a: the file decides, not its place in the list
  for (const std::byte b : seed.bytes) hash = (hash ^ std::uint32_t(b)) * 16777619u;
  return fuzz::mutate(seed.bytes, hash ^ (mutation * 0x9e37'79b9u), target.words, others);
}

// Returns 0, or how the child ended; `reached` is the mutation it was at.
int run_in_child(const Seed& seed, const Options& options, const fuzz::Target& target,
                 std::span<const Bytes> others, volatile std::uint32_t* reached) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) {
    std::perror("fork");
    std::exit(1);
  }
  if (child == 0) {
    for (std::uint32_t k = 0; k <= options.mutations; ++k) {
      *reached = k;
      // An exact-size copy, so that a sanitizer sees a read past the end.
      const Bytes input = input_of(seed, k, target, others);
      alarm(kSecondsAnInput);
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
    }
    std::fflush(nullptr);
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

int replay(const Options& options, const fuzz::Target& target) {
  const std::vector<Seed> seeds = collect(options, target);
  std::vector<Bytes> others;
  for (const Seed& seed : seeds) others.push_back(seed.bytes);
  auto* reached = static_cast<volatile std::uint32_t*>(mmap(
      nullptr, sizeof(std::uint32_t), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  if (reached == MAP_FAILED) {
    std::perror("mmap");
    return 1;
  }
  int failures = 0;
  for (const Seed& seed : seeds) {
    const int status = run_in_child(seed, options, target, others, reached);
    if (status == 0) continue;
    const std::uint32_t mutation = *reached;
    std::printf("FAILED: %s, mutation %u (%s %d)\n", seed.name.c_str(), mutation,
                WIFSIGNALED(status) ? "signal" : "exit",
                WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status));
    if (!options.out.empty()) {
      const fs::path kept = options.out / ("failure-" + std::to_string(failures));
      save(kept, input_of(seed, mutation, target, others));
      std::printf("  kept as %s\n", kept.c_str());
    }
    ++failures;
  }
  std::printf("%zu files, %u mutations each, %d failures\n", seeds.size(), options.mutations,
              failures);
  return seeds.empty() || failures != 0;
}

int write_seeds(const fs::path& folder, const fuzz::Target& target) {
  fs::create_directories(folder);
  for (std::size_t i = 0; i < target.seeds.size(); ++i)
    save(folder / ("seed-" + std::to_string(i)), target.seeds[i]);
  return 0;
}

Options parse(int argc, char** argv) {
  Options out;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    const auto value = [&] { return i + 1 < argc ? argv[++i] : ""; };
    if (word == "--mutations")
      out.mutations = static_cast<std::uint32_t>(std::strtoul(value(), nullptr, 10));
    else if (word == "--max-bytes")
      out.max_bytes = std::strtoull(value(), nullptr, 10);
    else if (word == "--out")
      out.out = value();
    else if (word == "--write-seeds")
      out.seeds = value();
    else
      out.paths.emplace_back(word);
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = parse(argc, argv);
  const fuzz::Target target = fuzz::target();
  return options.seeds.empty() ? replay(options, target) : write_seeds(options.seeds, target);
}
