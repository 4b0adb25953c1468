// Puts a world together: models read once and placed often.
//
// libsdformat's time grows with the square of the number of models (30 s for 3,000), so that it
// never sees a whole world. <include>s are taken out and read from the store; inline models that
// are alike but for name and pose are parsed once; what is left goes to libsdformat in batches.
// Poses between models are resolved here (WorldFrames), poses within one by libsdformat.
#pragma once

#include "gsv/base/error.h"
#include "gsv/formats/sdf/model_store.h"
#include "gsv/formats/sdf/sdf_xml.h"
#include "gsv/model/world_description.h"

namespace gsv::formats {

// Reads the first <world> of `file`, which it changes on the way.
base::Result<model::WorldDescription> ReadWorld(XmlFile& file, ModelStore& store,
                                                base::Problems& problems);

}  // namespace gsv::formats
