// TLS as somebody speaks it who trusts nobody and shows nothing: to find out what a server tells to
// strangers.
#pragma once

#include <string>

namespace gsv::tls {

// Begins TLS on a connected socket, whoever answers, sends `request` and gives the beginning of the
// answer; empty: there is none. The socket's own time limits hold.
std::string ExchangeAsStranger(int descriptor, const std::string& request);

}  // namespace gsv::tls
