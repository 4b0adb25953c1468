// The internal classes of omniORB that this folder builds on. They are no documented interface:
// they may change with any release, so CMake takes the one release that they were read in
// (cmake/GsvOmniOrbVersion.cmake, ADR 029). No other file includes them.
//
// Whoever includes it needs omniORB's internal include folder, see ../CMakeLists.txt.
#pragma once

// Each of these headers needs those before it.
// clang-format off
#include <omniORB4/CORBA.h>
#include <omniORB4/minorCode.h>
#include <omniORB4/giopEndpoint.h>
#include <omniORB4/omniIOR.h>
#include <omniORB4/omniObjRef.h>
#include <omniORB4/omniURI.h>
#include <tcpSocket.h>
#include <SocketCollection.h>
#include <omniORB4/tcpConnection.h>
#include <omniORB4/tcpAddress.h>
#include <omniORB4/tcpEndpoint.h>
#include <omniORB4/tcpTransportImpl.h>
#include <omniORB4/unixConnection.h>
#include <omniORB4/unixAddress.h>
#include <omniORB4/unixEndpoint.h>
#include <omniORB4/unixTransportImpl.h>
// clang-format on
