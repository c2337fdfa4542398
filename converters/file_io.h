#pragma once

#include <string>
#include <vector>

#include "converters/files.h"

namespace pstrips::inline converters {

// The functions of the table of formats. [file_formats.cpp]

Result<LoadedFile> load_ply(const FileBytes& file, const std::string& path, const LoadOptions&);
Result<LoadedFile> load_obj(const FileBytes& file, const std::string& path, const LoadOptions&);
Result<LoadedFile> load_gltf(const FileBytes& file, const std::string& path, const LoadOptions&);
Result<LoadedFile> load_xyz(const FileBytes& file, const std::string& path, const LoadOptions&);
Result<LoadedFile> load_pstrip(const FileBytes& file, const std::string& path, const LoadOptions&);
Result<LoadedFile> load_pstripx(const FileBytes& file, const std::string& path, const LoadOptions&);
Result<LoadedFile> load_pm(const FileBytes& file, const std::string& path, const LoadOptions&);

/// Where a model goes, and what its companion is called: a name without a folder, empty when the
/// output is standard output, which has none.
struct OutputName {
  std::string path;
  std::string companion;
};
OutputName output_name(const std::string& path, FileFormat format);

/// The files of an output, the named one first.
struct FileSet {
  struct File {
    std::string path;
    Bytes bytes;
    WriteBytes write = {};  ///< when set, instead of `bytes`
  };
  std::vector<File> files;
  std::vector<std::string> notes;      ///< what was left out
  std::vector<std::string> converted;  ///< what became something else
};

Result<FileSet> make_ply(const Model& model, const OutputName& name, const SaveOptions& options);
Result<FileSet> make_obj(const Model& model, const OutputName& name, const SaveOptions& options);
Result<FileSet> make_gltf(const Model& model, const OutputName& name, const SaveOptions& options);
Result<FileSet> make_glb(const Model& model, const OutputName& name, const SaveOptions& options);
/// The strips outlive the set.
Result<FileSet> make_pstrip(const ProgressiveStrips& strips, const OutputName& name);
Result<FileSet> make_pstripx(const ProgressiveStrips& strips, const OutputName& name);
Result<FileSet> make_pm(const ProgressiveStrips& strips, const OutputName& name);

}  // namespace pstrips::inline converters
