//! How a subject is started and ended on this system.

use std::process::{Child, Command};

/// Puts the process to be started into a group of its own.
#[cfg(unix)]
pub(super) fn in_own_group(command: &mut Command) {
    std::os::unix::process::CommandExt::process_group(command, 0);
}

/// Kills the process and everything that it started and that has not left its group.
#[cfg(unix)]
pub(super) fn kill(child: &mut Child) {
    use nix::sys::signal::{Signal, killpg};
    use nix::unistd::Pid;

    // A process that leads its group gives the group its number, and the number is not given again while the
    // group has members. Neither call has a failure that could be acted upon: the group may be gone.
    if let Ok(group) = i32::try_from(child.id())
        && group > 1
    {
        let _gone = killpg(Pid::from_raw(group), Signal::SIGKILL);
    }
    let _gone = child.kill();
}

/// Nothing: there are no process groups here.
#[cfg(not(unix))]
pub(super) fn in_own_group(_: &mut Command) {}

/// Kills the process.
#[cfg(not(unix))]
pub(super) fn kill(child: &mut Child) {
    let _gone = child.kill();
}
