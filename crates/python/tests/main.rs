//! Functions and classes of the module beside those of its stubs, read from their sources. What they do is tested in Python.

/// Names that stand between `before` and the next `after`, sorted.
fn names(text: &str, before: &str, after: &[char]) -> Vec<String> {
    let mut found: Vec<String> = text
        .split(before)
        .skip(1)
        .map(|rest| {
            rest.split(after).next().unwrap_or_default().rsplit("::").next().unwrap_or_default().to_owned()
        })
        .collect();
    found.sort();
    found
}

#[test]
fn every_class_and_function_has_a_stub() {
    let (module, stubs) = (include_str!("../src/lib.rs"), include_str!("../edgewalk.pyi"));
    let mut classes = names(module, "add_class::<", &['>']);
    assert_eq!(classes.len(), 6);
    classes.push("Error".to_owned());
    classes.sort();
    assert_eq!(classes, names(stubs, "\nclass ", &['(', ':']));
    let functions = names(module, "wrap_pyfunction!(", &[',']);
    assert_eq!(functions.len(), 6);
    assert_eq!(functions, names(stubs, "\ndef ", &['(']));
}
