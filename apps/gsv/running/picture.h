// Pictures as files, of what people asked to see.
#pragma once

#include <string>

#include "gsv/base/error.h"
#include "gsv/model/image.h"
#include "gsv/world/snapshot.h"

namespace gsv::app {

// A sentence when it does not end with .jpg, .jpeg or .png; else empty.
std::string CheckPictureName(const std::string& path);

base::Status WritePicture(const model::Image& picture, const std::string& path);

// A body and what is about it, from behind and above.
base::Status DrawAround(const std::shared_ptr<const world::Snapshot>& snapshot,
                        const std::string& body, const std::string& path);

}  // namespace gsv::app
