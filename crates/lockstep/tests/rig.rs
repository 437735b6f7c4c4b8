//! The rig alone, before a device that takes whatever it is offered.

use edgewalk_lockstep::case::constants;
use edgewalk_lockstep::{Interface, Rig, Setting, Unit};
use edgewalk_machine::Plan;
use edgewalk_model::DrawState;

#[test]
fn no_more_tokens_are_offered_than_are_permitted() {
    let plan = Plan::default();
    let interface = Interface::new(&plan, Unit::named("span").expect("declared"));
    let willing = Setting::willing(&interface, &constants(&DrawState::default())).expect("no constants");
    let link = &interface.links[0];
    let tokens = vec![vec![0; link.fields.len()]; 5];
    let (mut rig, mut ports) = (Rig::new(&interface, Setting { tokens, ..willing }), interface.values());
    for (permitted, sent) in [(2, 2), (3, 3), (3, 3), (9, 5)] {
        rig.permit(permitted);
        for _ in 0..8 {
            rig.drive(&mut ports);
            ports.set(link.ready, true);
            rig.clock(&ports);
        }
        assert_eq!((rig.sent(), rig.exhausted(), rig.finished()), (sent, true, sent == 5), "{permitted}");
    }
}
