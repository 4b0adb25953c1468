// Renders images to files for users.
#pragma once

#include <string>
#include <string_view>

#include "gsv/base/error.h"
#include "gsv/model/image.h"
#include "gsv/world/snapshot.h"

namespace gsv::app {

// Returns a sentence if the name does not end with .jpg, .jpeg or .png, else an empty text.
std::string CheckImageName(const std::string& path);

// Encodes an image, as the extension of `path` says, and writes it.
base::Status WriteImage(const model::Image& image, const std::string& path);
// Writes an encoded image.
base::Status WriteImageFile(std::string_view bytes, const std::string& path);

// Renders a body and its environment, from behind and above.
base::Status DrawAround(const std::shared_ptr<const world::Snapshot>& snapshot,
                        const std::string& body, const std::string& path);

}  // namespace gsv::app
