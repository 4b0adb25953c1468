# The part of idl/ that wander.tcl uses, in the form that Combat requires. The program idl2tcl
# prints this form, but it needs an interface repository. docs/services.md describes the interfaces.
package require combat

namespace eval sba {
    # "Sonar" -> "IDL:gsv/sba/Sonar:1.0"
    proc id {name} { return "IDL:gsv/sba/$name:1.0" }

    proc exception {name} {
        list exception [list [id $name] $name 1.0] {{reason string}} {}
    }
    proc struct {name members} {
        list struct [list [id $name] $name 1.0] $members {}
    }
    proc enum {name members} {
        list enum [list [id $name] $name 1.0] $members
    }
    # `operations`: {result name {{in name type} ...}} each; all may raise the four exceptions.
    proc interface {name operations} {
        set raises [lmap exception {Refused NotRunning Ended Failed} {id $exception}]
        set contents {}
        foreach operation $operations {
            lassign $operation result called parameters
            lappend contents [list operation [list [id $name/$called] $called 1.0] \
                                  $result $parameters $raises]
        }
        list interface [list [id $name] $name 1.0] {} $contents
    }
}

combat::ir add [list \
    [sba::exception Refused] [sba::exception NotRunning] \
    [sba::exception Ended] [sba::exception Failed] \
    [sba::struct Placement {{x_m double} {y_m double} {z_m double}
                            {roll_rad double} {pitch_rad double} {yaw_rad double}}] \
    [sba::enum WaitOutcome {REACHED NOT_YET}] \
    [sba::interface Sonar {{double range {}}}] \
    [sba::interface SensorFactory [list \
        [list [sba::id Sonar] create_sonar \
             [list {in name string} [list in mounting [sba::id Placement]] \
                  {in min_m double} {in max_m double}]]]] \
    [sba::interface ActuatorProxy {
        {void drive {{in linear_m_s double} {in angular_rad_s double}}}}] \
    [sba::interface Clock [list \
        {{long long} now {}} \
        [list [sba::id WaitOutcome] sleep_until {{in instant {long long}}}] \
        {void close {}}]] \
    [sba::interface Hardware [list \
        {double footprint_radius_m {}} \
        [list [sba::id SensorFactory] sensor_factory {}] \
        [list [sba::id ActuatorProxy] base {}] \
        [list [sba::id Clock] open_clock {}]]] \
    [sba::interface AgentBehaviour [list \
        [list void init [list {in agent_name string} [list in robot [sba::id Hardware]]]] \
        {void start {}} {void stop {}} {void pause {}} {void resume {}} {void destroy {}}]] \
    [sba::interface AgentBehaviourFactory [list \
        [list [sba::id AgentBehaviour] create {}]]]]

# Offers `factory` as a behaviour at a broker: any OMG Trading Service.
namespace eval trading {
    variable type gsv::AgentBehaviourFactory
    variable property {struct IDL:omg.org/CosTrading/Property:1.0 {name string value any}}
    variable declaration {struct IDL:omg.org/CosTradingRepos/ServiceTypeRepository/PropStruct:1.0 {
        name string value_type TypeCode
        mode {enum {PROP_NORMAL PROP_READONLY PROP_MANDATORY PROP_MANDATORY_READONLY}}}}
    variable incarnation {struct
        IDL:omg.org/CosTradingRepos/ServiceTypeRepository/IncarnationNumber:1.0
        {high {unsigned long} low {unsigned long}}}

    proc add_type {lookup} {
        variable type
        variable declaration
        variable incarnation
        set properties {}
        foreach {name value_type mode} {
            name string PROP_MANDATORY          description string PROP_NORMAL
            host string PROP_MANDATORY_READONLY pid long PROP_MANDATORY_READONLY
            time_managed boolean PROP_MANDATORY_READONLY
        } {
            lappend properties [list name $name value_type $value_type mode $mode]
        }
        set types [corba::dii $lookup {Object _get_type_repos {}}]
        corba::dii $types [list $incarnation add_type \
            [list {in string} {in string} [list in [list sequence $declaration]] \
                 {in {sequence string}}]] \
            $type [sba::id AgentBehaviourFactory] $properties {}
    }

    proc export {broker factory name description} {
        variable type
        variable property
        set lookup [corba::string_to_object $broker]
        catch {add_type $lookup}  ;# the type exists if a program of GSV has used the broker
        set register [corba::dii $lookup {Object _get_register_if {}}]
        set properties [list \
            [list name name value [list string $name]] \
            [list name description value [list string $description]] \
            [list name host value [list string [info hostname]]] \
            [list name pid value [list long [pid]]] \
            [list name time_managed value {boolean 1}]]
        corba::dii $register [list string export \
            [list {in Object} {in string} [list in [list sequence $property]]]] \
            $factory $type $properties
    }

    # "corbaloc::1.2@HOST:PORT/…" -> {HOST PORT}
    proc address {broker} {
        if {![regexp {^corbaloc:(?:iiop)?:(?:1\.\d@)?([^:/,]+):(\d+)/} $broker -> host port]} {
            error "the reference has not the form corbaloc::1.2@HOST:PORT/TradingService: $broker"
        }
        return [list $host $port]
    }
}
