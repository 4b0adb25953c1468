// Makes libsdformat share the descriptions of elements.
//
// libsdformat's own functions take much time. For each element that libsdformat reads, they copy
// the element's description with all descriptions below it, some thousand objects for a <model>,
// although nobody changes the copies. For each nested model, they parse the files of the schema
// again.
//
// shared_descriptions.cc defines two of these functions again. Its sdf::Element::Clone() makes a
// copy that refers to the same descriptions as the original. Its sdf::initFile() copies a
// description that was made before, instead of parsing files. libsdformat calls these definitions
// instead of its own if the program exports them.
//
// Threads  one at a time, as for all of libsdformat. Documents may be deleted at any time.
#pragma once

namespace gsv::formats {

// Whether libsdformat calls the definitions of shared_descriptions.cc. If not, reading takes
// longer. Call with SdformatMutex() locked.
bool SharesDescriptions();

}  // namespace gsv::formats
