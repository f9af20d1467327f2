//! The scenes, as `host-render emit` wrote them.

#![expect(missing_docs, reason = "written by a program, one module a scene")]

include!(concat!(env!("OUT_DIR"), "/scenes.rs"));
