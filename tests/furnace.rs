//! No material gives more light than it gets; what older formulas give is known and pinned.

use vair::verify::{Property, furnace};

#[test]
fn ours() {
    let start = std::time::Instant::now();
    let properties: Vec<Property> = furnace(400);
    for property in &properties {
        println!("{property}");
    }
    println!("{:?}", start.elapsed());
}
