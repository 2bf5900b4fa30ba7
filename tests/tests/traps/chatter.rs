//! Trap 2: the located end of a contact has a penetration of plus or minus round-off,
//! and "open and not negative means closed" closes it again, for ever.

use super::agrees;
use super::case::{Case, Chain, Law, METHODS, restless};
use super::exact::{GIVE_UP, Rules, solve};

/// Locates events as well as the truth does, stops on their near side, and closes a
/// gap wherever its penetration is not negative.
const NAIVE: Rules = Rules {
    closes_wherever_closed: true,
    ..Rules::EXACT
};

fn laws() -> [Law; 5] {
    let k = 1.0e8;
    [
        Law::Spring { k },
        Law::KelvinVoigt { k, zeta: 0.14 },
        Law::NoTension { k, zeta: 0.14 },
        Law::ApproachOnly { k, zeta: 0.35 },
        Law::DryFriction { k, friction: 0.4 },
    ]
}

#[test]
fn a_contact_that_ended_stays_ended() {
    for law in laws() {
        let chains = [
            Chain::single(2.0e4, 0.5, 0.05),
            Chain::single(5.0e4, 0.23, 0.05),
        ];
        let case = Case::pair(chains, 0.002, law, restless(300, 0.05, 1.0, 1.5));
        let truth = solve(&case, Rules::EXACT);
        assert!(truth.impacts.len() > 10, "{law:?}: {}", truth.impacts.len());
        let naive = solve(&case, NAIVE);
        assert!(
            naive.gave_up && naive.impacts.len() >= GIVE_UP / 3,
            "{law:?}"
        );
        // All of them at one instant.
        let last = &naive.impacts[naive.impacts.len() - GIVE_UP / 4..];
        assert!(
            last[last.len() - 1].closed - last[0].closed < 1e-12,
            "{law:?}"
        );
        for method in METHODS {
            let outcome = case.run(method);
            agrees(&format!("{law:?}"), &outcome, &truth, 1e-7);
            for pair in outcome.impacts.windows(2) {
                let pause = pair[1].time_closed - pair[0].time_opened;
                assert!(pause > 1e-6, "{law:?}: apart for {pause} s");
            }
        }
    }
}
