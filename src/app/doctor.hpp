#pragma once

namespace hibi {

/// `hibi doctor`: tries what a run needs on this machine and prints what works and which Debian package
/// brings what does not. Returns the exit status: 0 where a film can be made, 1 where something for it is
/// missing.
int doctor_command(bool json);

}  // namespace hibi
