// Reads a world. A model that is placed several times is read once.
//
// The time that libsdformat needs grows with the square of the number of models (30 s for 3,000).
// Therefore GSV never passes a whole world to libsdformat. The ModelStore reads the files of
// <include>s. Inline models that differ only in name and pose are parsed once, in batches.
// WorldFrames resolves poses between models, and libsdformat resolves poses within a model.
#pragma once

#include "gsv/base/error.h"
#include "gsv/formats/sdf/model_store.h"
#include "gsv/formats/sdf/sdf_xml.h"
#include "gsv/model/world_description.h"

namespace gsv::formats {

// Reads the first <world> of `file`. Changes the elements of `file`.
base::Result<model::WorldDescription> ReadWorld(XmlFile& file, ModelStore& store,
                                                base::Problems& problems);

}  // namespace gsv::formats
