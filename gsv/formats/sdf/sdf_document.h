// libsdformat behind one wall: its console silenced, its exceptions caught, its errors turned into
// problems.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include <sdf/Root.hh>

#include "gsv/base/error.h"
#include "gsv/base/mutex.h"
#include "gsv/formats/sdf/included_files.h"

namespace gsv::formats {

// A document as libsdformat sees it, and the file it stands for.
struct SdfDocument {
  std::unique_ptr<sdf::Root> root;
  std::filesystem::path source;
  // Poses cannot be resolved, maybe of more elements than the one that is wrong.
  bool has_broken_frames = false;
};

// Parses SDFormat or URDF text. What libsdformat refuses in SDFormat is repaired or left out, and
// named in a warning each (document_repair.h); the rest is read. Fails with one sentence when
// nothing is left. libsdformat has global state: calls wait for each other.
base::Result<SdfDocument> ParseSdf(const SdfText& document, const IncludedFiles& includes,
                                   base::Problems& problems);

// Hold it to call libsdformat's functions that read.
base::Mutex& SdformatMutex();
void SilenceConsoles() GSV_REQUIRES(SdformatMutex());

// The description of <sdf>, with those of all elements below it. Built once: this takes libsdformat
// longer than reading a small file. Read only.
sdf::ElementPtr SdfSchema() GSV_REQUIRES(SdformatMutex());

// The file in which an element stands, and "file:line: element path" for messages about it.
std::filesystem::path FileOf(const sdf::Element& element, const std::filesystem::path& source);
std::string PlaceOf(const sdf::Element& element, const std::filesystem::path& source);

}  // namespace gsv::formats
