// The internal classes of omniORB that this folder uses. They are not a documented interface and
// may change with any release. Therefore CMake accepts only the release for which this code was
// written (cmake/GsvOmniOrbVersion.cmake, ADR 029). No other file includes these headers of
// omniORB.
//
// A target that includes this file needs omniORB's internal include folder, see ../CMakeLists.txt.
#pragma once

// Each of these headers needs the headers before it.
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
