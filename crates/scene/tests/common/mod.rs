//! Files of the tests, and what is read back.

use edgewalk_scene::Mesh;
use glam::DVec3;
use std::fs;
use std::path::PathBuf;
use tempfile::TempDir;

pub fn file(name: &str, bytes: impl AsRef<[u8]>) -> (TempDir, PathBuf) {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join(name);
    fs::write(&path, bytes).unwrap();
    (dir, path)
}

pub fn read(name: &str, bytes: impl AsRef<[u8]>) -> Mesh {
    let (_dir, path) = file(name, bytes);
    Mesh::read(&path).unwrap()
}

pub fn refusal(name: &str, bytes: impl AsRef<[u8]>) -> String {
    let (_dir, path) = file(name, bytes);
    match Mesh::read(&path) {
        Ok(_) => panic!("accepted {name}"),
        Err(error) => error.to_string(),
    }
}

/// What lies on the front of a face.
pub fn front(mesh: &Mesh, face: usize) -> DVec3 {
    let [a, b, c] = mesh.corners(&mesh.faces()[face]);
    (b - a).cross(c - a).normalize()
}
