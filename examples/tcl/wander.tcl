#!/usr/bin/tclsh
# A behaviour in another language and with another ORB: Tcl with Combat (Debian: tcl-combat).
#
#   examples/tcl/wander.tcl --broker REFERENCE [--name NAME]
#   gsv run playground --broker REFERENCE --robot pebble --behaviour wander-tcl --lockstep
#
# Combat has one thread with an event loop, so no call may block. Each control loop is a coroutine,
# which is suspended until its call is answered. So one program can drive several robots. It is
# fastest with one robot, because Combat sends all calls over one connection, one after the other.
source [file join [file dirname [file normalize [info script]]] sba.tcl]

# Calls an operation from a coroutine. The event loop continues during the call.
proc call {object args} {
    $object -timeout 10000 -callback [info coroutine] {*}$args
    corba::request get [yield]
}

# Drives forward if there is space, else turns to the side with more space. Decides twenty times per
# simulated second.
proc wander {hardware base ahead left right} {
    set clock [call $hardware open_clock]
    set next [call $clock now]
    while 1 {
        if {[call $ahead range] > 0.6} {
            call $base drive 0.3 0.0
        } elseif {[call $left range] > [call $right range]} {
            call $base drive 0.0 0.9
        } else {
            call $base drive 0.0 -0.9
        }
        incr next 50000000
        # A wait returns NOT_YET after two seconds of wall-clock time. Repeat it until the instant.
        while {[call $clock sleep_until $next] eq "NOT_YET"} {}
    }
}

# `finished` is a variable that is set when the loop has ended.
proc run_to_its_end {finished arguments} {
    if {[catch {wander {*}$arguments} problem] && ![string match *sba/Ended* $problem]} {
        puts stderr "wander-tcl: $problem"
    }
    set $finished 1
}

itcl::class Wander {
    inherit PortableServer::ServantBase
    private variable robot {}
    private variable finished 1
    private common loops 0

    public method _Interface {} { return [sba::id AgentBehaviour] }

    public method init {agent_name hardware} {
        set factory [$hardware sensor_factory]
        # Combat releases the arguments of a call when the call returns, so this copies one.
        set robot [list [corba::duplicate $hardware] [$hardware base]]
        set radius [$hardware footprint_radius_m]
        foreach {name bearing} {ahead 0.0 left 0.8 right -0.8} {
            set mounting [list x_m [expr {$radius * cos($bearing)}] \
                              y_m [expr {$radius * sin($bearing)}] z_m 0.15 \
                              roll_rad 0.0 pitch_rad 0.0 yaw_rad $bearing]
            lappend robot [$factory create_sonar tcl_$name $mounting 0.02 3.0]
        }
    }

    # Returns at once. The event loop starts the coroutine later.
    public method start {} {
        set finished 0
        after 0 [list coroutine ::loop_[incr loops] run_to_its_end [itcl::scope finished] $robot]
    }

    # Waits for the end of the loop. Before this call, the loop's wait has raised Ended.
    public method stop {} {
        while {!$finished} { vwait [itcl::scope finished] }
    }
    public method pause {} {}
    public method resume {} {}

    public method destroy {} {
        stop
        set current [corba::resolve_initial_references POACurrent]
        [$current get_POA] deactivate_object [$current get_object_id]
        after 0 [list itcl::delete object $this]
    }
}

itcl::class WanderFactory {
    inherit PortableServer::ServantBase
    private variable poa

    constructor {its_poa} { set poa $its_poa }
    public method _Interface {} { return [sba::id AgentBehaviourFactory] }
    public method create {} {
        set behaviour [namespace current]::[Wander #auto]
        return [$poa id_to_reference [$poa activate_object $behaviour]]
    }
}

# By default, Combat listens on all addresses. Here it listens only on the address of this machine
# that the connection to the broker uses.
proc listen_towards {host port} {
    set probe [socket $host $port]
    set address [lindex [fconfigure $probe -sockname] 0]
    close $probe
    rename ::socket ::combat_socket
    proc ::socket {args} [format {
        if {[lindex $args 0] eq "-server"} { set args [linsert $args 0 -myaddr %s] }
        ::combat_socket {*}$args
    } $address]
    corba::init -ORBHostName $address
}

proc main {arguments} {
    array set option {--broker "" --name wander-tcl}
    if {[info exists ::env(GSV_BROKER)]} { set option(--broker) $::env(GSV_BROKER) }
    foreach {name value} $arguments {
        # gsv adds this option, which is ignored: the kernel ends the program together with gsv.
        if {$name eq "--exit-with-parent"} break
        set option($name) $value
    }
    if {$option(--broker) eq "" || [array size option] != 2} {
        puts stderr "usage: wander.tcl --broker REFERENCE \[--name NAME\]"
        exit 2
    }
    if {[catch {
        listen_towards {*}[trading::address $option(--broker)]
        set poa [corba::resolve_initial_references RootPOA]
        [$poa the_POAManager] activate
        set factory [WanderFactory #auto $poa]
        set reference [$poa id_to_reference [$poa activate_object $factory]]
        trading::export $option(--broker) $reference $option(--name) "Wanders about, in Tcl."
    } problem]} {
        puts stderr "$option(--broker): $problem"
        exit 5
    }
    puts "$option(--name): offered at $option(--broker)"
    flush stdout
    vwait forever
}

main $argv
