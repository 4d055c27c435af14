//! As much of JSON as the reference files use, read with the standard library alone, so that the tests need no registry.
//! SPDX-License-Identifier: MIT
use std::ops::Index;

#[derive(Clone, Debug, PartialEq)]
pub enum Json {
    Null,
    Bool(bool),
    Number(f64),
    Text(String),
    List(Vec<Json>),
    Object(Vec<(String, Json)>),
}

impl Json {
    /// Panics, naming the octet, where the text is no JSON.
    pub fn parse(text: &str) -> Json {
        let mut reader = Reader { text: text.as_bytes(), at: 0 };
        let value = reader.value();
        reader.space();
        assert_eq!(reader.at, reader.text.len(), "JSON goes on after its end at octet {}", reader.at);
        value
    }

    pub fn list(&self) -> &[Json] {
        match self {
            Json::List(list) => list,
            other => panic!("a list is wanted here: {other:?}"),
        }
    }

    pub fn entries(&self) -> &[(String, Json)] {
        match self {
            Json::Object(entries) => entries,
            other => panic!("an object is wanted here: {other:?}"),
        }
    }

    pub fn find(&self, key: &str) -> Option<&Json> {
        self.entries().iter().find(|entry| entry.0 == key).map(|entry| &entry.1)
    }

    pub fn number(&self) -> f64 {
        match self {
            Json::Number(number) => *number,
            other => panic!("a number is wanted here: {other:?}"),
        }
    }

    pub fn integer(&self) -> usize {
        let number = self.number();
        assert!(number >= 0.0 && number.fract() == 0.0, "a natural number is wanted here: {number}");
        number as usize
    }

    pub fn text(&self) -> &str {
        match self {
            Json::Text(text) => text,
            other => panic!("a string is wanted here: {other:?}"),
        }
    }

    pub fn bool(&self) -> bool {
        match self {
            Json::Bool(value) => *value,
            other => panic!("true or false is wanted here: {other:?}"),
        }
    }

    /// All numbers of nested lists, in order.
    pub fn flat(&self) -> Vec<f64> {
        match self {
            Json::List(list) => list.iter().flat_map(Json::flat).collect(),
            other => vec![other.number()],
        }
    }

    /// N numbers.
    pub fn array<const N: usize>(&self) -> [f64; N] {
        self.flat().try_into().unwrap_or_else(|got: Vec<f64>| panic!("{N} numbers are wanted here, got {}", got.len()))
    }

    /// A list of N numbers each.
    pub fn arrays<const N: usize>(&self) -> Vec<[f64; N]> {
        self.list().iter().map(Json::array).collect()
    }
}

impl Index<&str> for Json {
    type Output = Json;
    fn index(&self, key: &str) -> &Json {
        self.find(key).unwrap_or_else(|| panic!("no entry {key}"))
    }
}

impl Index<usize> for Json {
    type Output = Json;
    fn index(&self, index: usize) -> &Json {
        &self.list()[index]
    }
}

struct Reader<'a> {
    text: &'a [u8],
    at: usize,
}

impl Reader<'_> {
    fn space(&mut self) {
        while self.text.get(self.at).is_some_and(u8::is_ascii_whitespace) {
            self.at += 1;
        }
    }

    fn next(&mut self) -> u8 {
        let octet = *self.text.get(self.at).expect("JSON ends too early");
        self.at += 1;
        octet
    }

    fn expect(&mut self, word: &str) {
        assert!(self.text[self.at..].starts_with(word.as_bytes()), "no {word} at octet {}", self.at);
        self.at += word.len();
    }

    /// After an element: whether another follows, else `end` is taken.
    fn more(&mut self, end: u8) -> bool {
        self.space();
        match self.next() {
            b',' => true,
            octet if octet == end => false,
            _ => panic!("neither comma nor end at octet {}", self.at - 1),
        }
    }

    fn value(&mut self) -> Json {
        self.space();
        match self.text.get(self.at).expect("JSON ends too early") {
            b'n' => {
                self.expect("null");
                Json::Null
            }
            b't' => {
                self.expect("true");
                Json::Bool(true)
            }
            b'f' => {
                self.expect("false");
                Json::Bool(false)
            }
            b'"' => Json::Text(self.string()),
            b'[' => self.list(),
            b'{' => self.object(),
            _ => self.number(),
        }
    }

    fn list(&mut self) -> Json {
        let mut list = Vec::new();
        self.at += 1;
        self.space();
        if self.text.get(self.at) == Some(&b']') {
            self.at += 1;
            return Json::List(list);
        }
        loop {
            list.push(self.value());
            if !self.more(b']') {
                return Json::List(list);
            }
        }
    }

    fn object(&mut self) -> Json {
        let mut entries = Vec::new();
        self.at += 1;
        self.space();
        if self.text.get(self.at) == Some(&b'}') {
            self.at += 1;
            return Json::Object(entries);
        }
        loop {
            self.space();
            let key = self.string();
            self.space();
            self.expect(":");
            entries.push((key, self.value()));
            if !self.more(b'}') {
                return Json::Object(entries);
            }
        }
    }

    fn string(&mut self) -> String {
        self.expect("\"");
        let mut octets = Vec::new();
        loop {
            match self.next() {
                b'"' => return String::from_utf8(octets).expect("JSON is UTF-8"),
                b'\\' => match self.next() {
                    b'n' => octets.push(b'\n'),
                    escaped @ (b'"' | b'\\' | b'/') => octets.push(escaped),
                    other => panic!("escape \\{} at octet {} is not known here", char::from(other), self.at - 1),
                },
                octet => octets.push(octet),
            }
        }
    }

    fn number(&mut self) -> Json {
        let start = self.at;
        while self.text.get(self.at).is_some_and(|octet| b"+-.eE0123456789".contains(octet)) {
            self.at += 1;
        }
        let text = std::str::from_utf8(&self.text[start..self.at]).expect("ASCII");
        Json::Number(text.parse().unwrap_or_else(|_| panic!("no JSON value at octet {start}")))
    }
}
