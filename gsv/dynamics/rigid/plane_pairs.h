// Leaves out what Bullet would look at in vain: a plane has no end, so that its box meets every
// body's, wherever that is. Private to this folder: it includes Bullet.
#pragma once

#include <btBulletCollisionCommon.h>

namespace gsv::dynamics {

// To be the dispatcher's near callback. Passes on all pairs but those of a plane and a body whose
// box stays above it and did so in all substeps before; such a pair has no contacts.
void LookAtPairsThatMayTouch(btBroadphasePair& pair, btCollisionDispatcher& dispatcher,
                             const btDispatcherInfo& info);

}  // namespace gsv::dynamics
