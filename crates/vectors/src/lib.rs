//! Stimuli, expected results, manifests and test benches
