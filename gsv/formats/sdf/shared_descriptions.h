// Makes libsdformat share the descriptions of elements.
//
// For each element that libsdformat reads, it copies the element's description with all
// descriptions below it. For a <model>, these are some thousand objects. libsdformat does not
// change them afterwards. For each nested model, it parses the files of its schema. This file
// defines sdf::Element::Clone(), so that a copy refers to the same descriptions as its original. It
// defines sdf::initFile(), which copies a description that was made before. libsdformat calls these
// definitions if the program exports them.
//
// Threads  one at a time, as for all of libsdformat. Documents may be deleted at any time.
#pragma once

namespace gsv::formats {

// Whether libsdformat calls this file's definitions. If not, reading takes longer. Call with
// SdformatMutex() locked.
bool SharesDescriptions();

}  // namespace gsv::formats
