// The functions of OpenGL 4.5. They are those of libOpenGL, which passes each call to the driver of
// the current context.
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>
