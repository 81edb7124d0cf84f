//! What a host's pointers become: references, slices and text, or a failure that names the argument.

use crate::result::Failure;
use glam::Mat4;
use std::ffi::{CStr, c_char};
use std::mem::MaybeUninit;

fn check<T>(pointer: *const T, name: &str) -> Result<(), Failure> {
    if pointer.is_null() {
        return Err(Failure::argument(format!("{name} is NULL")));
    }
    if !pointer.is_aligned() {
        return Err(Failure::argument(format!("{name} is not aligned for its type")));
    }
    Ok(())
}

/// # Safety
/// NULL, or a valid `T` that nobody changes for as long as the reference is used.
pub(crate) unsafe fn shared<'a, T>(pointer: *const T, name: &str) -> Result<&'a T, Failure> {
    check(pointer, name)?;
    // SAFETY: not NULL, aligned, and valid by this function's contract.
    Ok(unsafe { &*pointer })
}

/// # Safety
/// NULL, or a valid `T` that nobody else uses for as long as the reference is used.
pub(crate) unsafe fn exclusive<'a, T>(pointer: *mut T, name: &str) -> Result<&'a mut T, Failure> {
    check(pointer, name)?;
    // SAFETY: not NULL, aligned, and valid by this function's contract.
    Ok(unsafe { &mut *pointer })
}

/// Where a result goes.
///
/// # Safety
/// NULL, or memory for a `T` that nobody else uses for as long as the reference is used.
pub(crate) unsafe fn result<'a, T>(pointer: *mut T, name: &str) -> Result<&'a mut MaybeUninit<T>, Failure> {
    // SAFETY: the contract is the same, and `MaybeUninit` asks nothing of the memory's contents.
    unsafe { exclusive(pointer.cast(), name) }
}

/// Where a handle goes: NULL until there is one.
///
/// # Safety
/// That of [`result`].
pub(crate) unsafe fn handle<'a, T>(pointer: *mut *mut T, name: &str) -> Result<&'a mut *mut T, Failure> {
    // SAFETY: the contract is the same.
    let slot = unsafe { result(pointer, name) }?;
    Ok(slot.write(std::ptr::null_mut()))
}

/// `count` elements; none where that is 0, whatever the pointer.
///
/// # Safety
/// NULL, or that many valid elements that nobody changes for as long as the slice is used.
pub(crate) unsafe fn slice<'a, T>(pointer: *const T, count: usize, name: &str) -> Result<&'a [T], Failure> {
    if count == 0 {
        return Ok(&[]);
    }
    check(pointer, name)?;
    if count.checked_mul(size_of::<T>()).is_none_or(|bytes| bytes > isize::MAX as usize) {
        return Err(Failure::argument(format!("{name}: {count} elements are more than memory can hold")));
    }
    // SAFETY: not NULL, aligned, not larger than memory, and valid by this function's contract.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// The same to write to.
///
/// # Safety
/// NULL, or that many valid elements that nobody else uses for as long as the slice is used.
pub(crate) unsafe fn slice_mut<'a, T>(pointer: *mut T, count: usize, name: &str) -> Result<&'a mut [T], Failure> {
    // SAFETY: the contract is the stricter one.
    unsafe { slice(pointer, count, name) }?;
    if count == 0 {
        return Ok(&mut []);
    }
    // SAFETY: `slice` has checked it; nobody else uses the elements by this function's contract.
    Ok(unsafe { std::slice::from_raw_parts_mut(pointer, count) })
}

/// Text.
///
/// # Safety
/// NULL, or text that ends with NUL and that nobody changes for as long as the reference is used.
pub(crate) unsafe fn text<'a>(pointer: *const c_char, name: &str) -> Result<&'a str, Failure> {
    check(pointer, name)?;
    // SAFETY: not NULL, and ended by this function's contract.
    let text = unsafe { CStr::from_ptr(pointer) };
    text.to_str().map_err(|error| {
        Failure::argument(format!("{name}: byte {} is not UTF-8; pass UTF-8 text", error.valid_up_to()))
    })
}

/// Text that may be left out.
///
/// # Safety
/// That of [`text`].
pub(crate) unsafe fn optional_text<'a>(pointer: *const c_char, name: &str) -> Result<Option<&'a str>, Failure> {
    if pointer.is_null() {
        return Ok(None);
    }
    // SAFETY: the contract is the same.
    unsafe { text(pointer, name) }.map(Some)
}

/// A matrix of 16 numbers, column by column.
///
/// # Safety
/// NULL, or 16 numbers that nobody changes during the call.
pub(crate) unsafe fn matrix(pointer: *const f32, name: &str) -> Result<Mat4, Failure> {
    // SAFETY: 16 numbers by this function's contract.
    let numbers = unsafe { slice(pointer, 16, name) }?;
    Ok(Mat4::from_cols_slice(numbers))
}

/// Ends what a handle stands for. NULL is nothing.
///
/// # Safety
/// NULL, or what [`Box::into_raw`] gave and nobody has freed or uses any more.
pub(crate) unsafe fn free<T>(pointer: *mut T) {
    if !pointer.is_null() {
        // SAFETY: it comes from a box by this function's contract.
        drop(unsafe { Box::from_raw(pointer) });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_right_is_named() {
        // SAFETY: NULL is allowed.
        let error = unsafe { shared::<u32>(std::ptr::null(), "desc") }.unwrap_err();
        assert!(format!("{error:?}").contains("desc is NULL"), "{error:?}");
        let words = [0_u32; 2];
        let askew = words.as_ptr().wrapping_byte_add(1);
        // SAFETY: it is refused before it is read.
        assert!(unsafe { shared(askew, "desc") }.is_err());
        // SAFETY: it is refused before it is read.
        assert!(unsafe { slice(words.as_ptr(), usize::MAX, "indices") }.is_err());
        // SAFETY: nothing is read.
        assert!(unsafe { slice::<u32>(std::ptr::null(), 0, "indices") }.unwrap().is_empty());
    }

    #[test]
    fn text_that_is_not_utf_8_is_refused() {
        // SAFETY: it ends with NUL.
        let error = unsafe { text(c"wei\xdf".as_ptr(), "key") }.unwrap_err();
        assert!(format!("{error:?}").contains("byte 3"), "{error:?}");
    }
}
