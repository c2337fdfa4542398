// Writes tests/data/valid, tests/data/invalid, tests/data/reports and spec/rules.md anew, to be
// reviewed as a diff:
//   validators.make_corpus SOURCE_DIRECTORY

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tests/validators/corpus.h"

namespace {

bool write(const std::filesystem::path& path, pstrips::ByteView bytes) {
  std::ofstream out(path, std::ios::binary);
  const std::string_view text = pstrips::as_text(bytes);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) std::fprintf(stderr, "cannot write %s\n", path.c_str());
  return out.good();
}

/// The folder holds these files afterwards and no others.
bool write_all(const std::filesystem::path& folder,
               const std::vector<pstrips::test::CorpusFile>& files) {
  std::error_code error;
  std::filesystem::remove_all(folder, error);
  std::filesystem::create_directories(folder, error);
  for (const pstrips::test::CorpusFile& file : files)
    if (!write(folder / file.name, file.bytes)) return false;
  return true;
}

/// What the validator says of each file.
std::vector<pstrips::test::CorpusFile> reports_of(
    const std::vector<pstrips::test::CorpusFile>& files) {
  std::vector<pstrips::test::CorpusFile> out;
  for (const pstrips::test::CorpusFile& file : files) {
    const std::string text = pstrips::test::report_text(file);
    const pstrips::ByteView bytes = pstrips::as_bytes(text);
    out.push_back({file.name + ".txt", pstrips::Bytes(bytes.begin(), bytes.end())});
  }
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: validators.make_corpus SOURCE_DIRECTORY\n");
    return 1;
  }
  const std::filesystem::path source = argv[1];
  const std::string page = pstrips::test::current_rules_page();
  const std::vector<pstrips::test::CorpusFile> invalid = pstrips::test::invalid_corpus();
  return write_all(source / "tests/data/valid", pstrips::test::valid_corpus()) &&
                 write_all(source / "tests/data/invalid", invalid) &&
                 write_all(source / "tests/data/reports", reports_of(invalid)) &&
                 write(source / "spec/rules.md", pstrips::as_bytes(page))
             ? 0
             : 2;
}
