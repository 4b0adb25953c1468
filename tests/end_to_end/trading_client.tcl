#!/usr/bin/tclsh
# A client of the broker on another ORB, in another language: Tcl with Combat (Debian: tcl-combat).
#
#   trading_client.tcl BROKER OTHER_BROKER
#
# Exports offers and a proxy, queries with every policy, iterates, adds a link, follows the link, and
# withdraws. Prints a line for each successful check. Exits with 1 at the first wrong answer.
package require combat

set id IDL:omg.org/CosTrading
set property [list struct $id/Property:1.0 {name string value any}]
set offer [list struct $id/Offer:1.0 [list reference Object properties [list sequence $property]]]
set policy [list struct $id/Policy:1.0 {name string value any}]
set desired [list union $id/Lookup/SpecifiedProps:1.0 {enum {none some all}} \
    {some {sequence string}}]
set dynamic_property [list struct IDL:omg.org/CosTradingDynamic/DynamicProp:1.0 \
    {eval_if Object returned_type TypeCode extra_info any}]
set follow {enum {local_only if_no_local always}}
set repository IDL:omg.org/CosTradingRepos/ServiceTypeRepository
set declaration [list struct $repository/PropStruct:1.0 {
    name string value_type TypeCode
    mode {enum {PROP_NORMAL PROP_READONLY PROP_MANDATORY PROP_MANDATORY_READONLY}}}]
set incarnation [list struct $repository/IncarnationNumber:1.0 \
    {high {unsigned long} low {unsigned long}}]

proc check {what found expected} {
    if {$found ne $expected} {
        puts stderr "$what: found \"$found\" instead of \"$expected\""
        exit 1
    }
    puts $what
}

# The exceptions that this client can decode, with their members.
set raises [list \
    [list exception $id/IllegalConstraint:1.0 {constr string}] \
    [list exception $id/Lookup/PolicyTypeMismatch:1.0 [list the_policy $policy]] \
    [list exception $id/Link/UnknownLinkName:1.0 {name string}]]

# Returns the id of the exception that `script` raises, or "nothing".
proc raised {script} {
    if {![catch {uplevel 1 $script} problem]} { return "nothing" }
    return [lindex $problem 0]
}

proc attribute {object name} { corba::dii $object [list Object _get_$name {}] }

# Queries, and returns the numbers n of all found offers, including those from the iterator, and the
# limits that the broker applied.
proc query {lookup constraint preference {policies {}} {how_many 100}} {
    global offer policy desired raises
    corba::dii -timeout 20000 $lookup [list void query [list {in string} {in string} {in string} \
        [list in [list sequence $policy]] [list in $desired] {in {unsigned long}} \
        [list out [list sequence $offer]] {out Object} {out {sequence string}}] $raises] \
        Robot $constraint $preference $policies all $how_many offers rest limits
    set numbers [numbers_of $offers]
    if {$rest ne "0"} {
        for {set more 1} {$more} {} {
            set more [corba::dii $rest [list boolean next_n [list {in {unsigned long}} \
                [list out [list sequence $offer]]]] 2 next]
            lappend numbers {*}[numbers_of $next]
        }
        corba::dii $rest {void destroy {}}
    }
    return [list $numbers $limits]
}

proc numbers_of {offers} {
    lmap found $offers {
        array set one $found
        set number {}
        foreach each $one(properties) {
            array set property $each
            if {$property(name) eq "n"} { set number [lindex $property(value) 1] }
        }
        set number
    }
}

proc policies {args} {
    set result {}
    foreach {name type value} $args {
        lappend result [list name $name value [list $type $value]]
    }
    return $result
}

proc export {lookup n {type Robot} {properties {}}} {
    global property
    corba::dii [attribute $lookup register_if] [list string export \
        [list {in Object} {in string} [list in [list sequence $property]]]] \
        $lookup $type [linsert $properties 0 [list name n value [list long $n]]]
}

proc withdraw {lookup id} {
    corba::dii [attribute $lookup register_if] {void withdraw {{in string}}} $id
}

# Exports a proxy. The broker passes all queries of importers that match it on to the target, whose
# offers replace the proxy in the results.
proc export_proxy {lookup target} {
    global property policy
    corba::dii [attribute $lookup proxy_if] [list string export_proxy \
        [list {in Object} {in string} [list in [list sequence $property]] {in boolean} \
             {in string} [list in [list sequence $policy]]]] \
        $target Robot {{name n value {long -1}}} 1 {$*} {}
}

proc add_type {lookup {type Robot} {properties {{name n value_type long mode PROP_MANDATORY}}} \
                   {super_types {}}} {
    global declaration incarnation
    corba::dii [attribute $lookup type_repos] [list $incarnation add_type \
        [list {in string} {in string} [list in [list sequence $declaration]] \
             {in {sequence string}}]] \
        $type "" $properties $super_types
}

corba::init
set near [corba::string_to_object [lindex $argv 0]]
set far [corba::string_to_object [lindex $argv 1]]
foreach lookup [list $near $far] { add_type $lookup }
for {set n 0} {$n < 6} {incr n} { lappend ids [export $near $n] }
export $far 100
export $far 101

check "queries" [query $near "n >= 2 and n < 4" "max n"] {{3 2} {}}
check "iterates" [query $near "" "min n" {} 1] {{0 1 2 3 4 5} {}}
set ulong {unsigned long}
foreach {name type value constraint expected} [list \
    search_card $ulong 2 "" {{0 1} search_card} \
    match_card $ulong 2 "" {{0 1} match_card} \
    return_card $ulong 2 "" {{0 1} return_card} \
    exact_type_match boolean 1 "n < 2" {{0 1} {}} \
    use_modifiable_properties boolean 1 "n < 2" {{0 1} {}} \
    use_dynamic_properties boolean 0 "n < 2" {{0 1} {}} \
    use_proxy_offers boolean 0 "n < 2" {{0 1} {}} \
    hop_count $ulong 3 "n < 2" {{0 1} {}} \
    link_follow_rule $follow local_only "n < 2" {{0 1} {}} \
    starting_trader {sequence string} {} "n < 2" {{0 1} {}} \
    request_id {sequence octet} tcl "n < 2" {{0 1} {}}] {
    check "policy $name" [query $near $constraint "" [policies $name $type $value]] $expected
}

# Policies that exclude offers.
check "answers a request once" [query $near "n < 2" "" [policies request_id {sequence octet} tcl]] \
    {{} {}}
check "without what can be modified" \
    [query $near "n < 2" "" [policies use_modifiable_properties boolean 0]] {{} {}}
add_type $near Walker {} Robot
set walker [export $near 50 Walker]
check "finds sub types" [query $near "n > 4" "min n"] {{5 50} {}}
check "finds the very type" \
    [query $near "n > 4" "min n" [policies exact_type_match boolean 1]] {5 {}}
withdraw $near $walker
set dynamic [export $near 60 Robot [list [list name now value [list $dynamic_property \
    [list eval_if $near returned_type long extra_info {long 0}]]]]]
check "finds what has dynamic properties" [query $near "n > 4" "min n"] {{5 60} {}}
check "finds what has none" \
    [query $near "n > 4" "min n" [policies use_dynamic_properties boolean 0]] {5 {}}
withdraw $near $dynamic
set proxy [export_proxy $near $far]
check "asks through a proxy" [query $near "n > 4" "min n"] {{5 100 101} {}}
check "asks no proxy" [query $near "n > 4" "min n" [policies use_proxy_offers boolean 0]] {5 {}}
corba::dii [attribute $near proxy_if] {void withdraw_proxy {{in string}}} $proxy

check "refused constraint" [raised {query $near "n <" ""}] $id/IllegalConstraint:1.0
check "refused policy" [raised {query $near "" "" [policies hop_count string x]}] \
    $id/Lookup/PolicyTypeMismatch:1.0

set links [attribute $near link_if]
corba::dii $links [list void add_link [list {in string} {in Object} [list in $follow] \
    [list in $follow]]] far $far always always
check "links" [corba::dii $links {{sequence string} list_links {}}] far
check "follows the link" [query $near "n >= 5" "max n" [policies link_follow_rule $follow always]] \
    {{101 100 5} {}}
check "makes no hop" [query $near "n >= 5" "max n" \
    [policies link_follow_rule $follow always hop_count $ulong 0]] {5 hop_count}
check "starts elsewhere" [query $near "" "min n" [policies starting_trader {sequence string} far]] \
    {{100 101} {}}
corba::dii $links {void remove_link {{in string}}} far
check "unlinks" [raised {
    corba::dii $links [list void remove_link {{in string}} $raises] far
}] \
    $id/Link/UnknownLinkName:1.0

set register [attribute $near register_if]
withdraw $near [lindex $ids 0]
check "withdraws" [query $near "" "min n"] {{1 2 3 4 5} {}}
corba::dii $register {void withdraw_using_constraint {{in string} {in string}}} Robot "n > 2"
check "withdraws by constraint" [query $near "" "min n"] {{1 2} {}}
