// Encapsulates libsdformat: silences its console, catches its exceptions, and converts its errors
// to problems.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <sdf/Root.hh>

#include "gsv/base/error.h"
#include "gsv/base/mutex.h"
#include "gsv/formats/sdf/included_files.h"

namespace gsv::formats {

// A document read by libsdformat, and its file.
struct SdfDocument {
  std::unique_ptr<sdf::Root> root;  // the document as libsdformat has read it
  std::filesystem::path source;     // path of the file
  // True if libsdformat found an error in the graph of frames. Then it may fail to resolve poses,
  // even those of valid elements.
  bool has_broken_frames = false;
};

// Parses SDFormat or URDF text. Parts of SDFormat that libsdformat refuses are repaired or left
// out, each with a warning (document_repair.h). All other parts are read. Fails with one sentence
// if nothing is left. libsdformat has global state, so calls run one after another.
base::Result<SdfDocument> ParseSdf(const SdfText& document, const IncludedFiles& includes,
                                   base::Problems& problems);

// Lock this mutex while you call libsdformat's functions that read.
base::Mutex& SdformatMutex();
// Stops libsdformat's and urdfdom's output on the console. The reader stores urdfdom's errors.
void SilenceConsoles() GSV_REQUIRES(SdformatMutex());

// Returns the description of <sdf> and of all elements below it. The description is made once,
// because making it takes longer than reading a small file. It must not be changed.
sdf::ElementPtr SdfSchema() GSV_REQUIRES(SdformatMutex());

// These functions return the file that contains an element, and "file:line: element path" for
// messages about it.
std::filesystem::path FileOf(const sdf::Element& element, const std::filesystem::path& source);
std::string PlaceOf(const sdf::Element& element, const std::filesystem::path& source);

}  // namespace gsv::formats
