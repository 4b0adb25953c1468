// Copies elements of libsdformat without the descriptions below them.
//
// For each element that libsdformat reads, it copies the element's description with all descriptions
// below it: for a <model> some thousand objects, none of which it changes afterwards. This file defines
// sdf::Element::Clone(), so that a copy refers to the same descriptions as its original. libsdformat
// calls this definition if the program exports it.
//
// Threads  those of libsdformat: descriptions are only read, and their counts of owners are atomic.
#pragma once

namespace gsv::formats {

// Whether libsdformat calls the definition here. Otherwise, reading takes longer. Call with
// SdformatMutex() locked.
bool SharesDescriptions();

}  // namespace gsv::formats
