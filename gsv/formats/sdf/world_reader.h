// Reads a world. A model that is placed several times is read once.
//
// libsdformat's time grows with the square of the number of models (30 s for 3,000), so it never
// reads a whole world. The store reads <include>s. Inline models that differ only in name and pose
// are parsed once. libsdformat reads the rest in batches.
// WorldFrames resolves poses between models, libsdformat those within a model.
#pragma once

#include "gsv/base/error.h"
#include "gsv/formats/sdf/model_store.h"
#include "gsv/formats/sdf/sdf_xml.h"
#include "gsv/model/world_description.h"

namespace gsv::formats {

// Reads the first <world> of `file`, and changes `file` for that.
base::Result<model::WorldDescription> ReadWorld(XmlFile& file, ModelStore& store,
                                                base::Problems& problems);

}  // namespace gsv::formats
