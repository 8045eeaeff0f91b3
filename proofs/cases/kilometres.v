(** * kilometres: A layer on a ray of ten thousand, and thin air behind it

    Claim.  For every D on the ray, which has the length of the theorem's bound, the optical
    depth and the volume rendering integral of the field, extinction and emission below exist,
    and are [exact_depth D] and [exact_radiance D].

    Written by volver prove; not to be edited. *)

From Volver Require Import CaseTactic.

Module even.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  16000000 * s / (16000000000000 + 8000000 * s ^ 2 + s ^ 4).
Definition emission (s : R) : R :=
  1.
Definition exact_depth (lambda : R) : R :=
  2 * lambda ^ 2 / (lambda ^ 2 + 4000000).
Definition exact_radiance (lambda : R) : R :=
  1 - exp (-2 * lambda ^ 2 / (lambda ^ 2 + 4000000)).

Theorem kilometres_even (D : R) :
  0 <= D <= 10000 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End even.

Module rising.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  16000000 * s / (16000000000000 + 8000000 * s ^ 2 + s ^ 4).
Definition emission (s : R) : R :=
  1 + 2 * s ^ 2 / (s ^ 2 + 4000000).
Definition exact_depth (lambda : R) : R :=
  2 * lambda ^ 2 / (lambda ^ 2 + 4000000).
Definition exact_radiance (lambda : R) : R :=
  2 - (2 + 2 * lambda ^ 2 / (lambda ^ 2 + 4000000)) * exp (-2 * lambda ^ 2 / (lambda ^ 2 + 4000000)).

Theorem kilometres_rising (D : R) :
  0 <= D <= 10000 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End rising.

Module sloping.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  16000000 * s / (16000000000000 + 8000000 * s ^ 2 + s ^ 4).
Definition emission (s : R) : R :=
  3 - 2 * s ^ 2 / (s ^ 2 + 4000000).
Definition exact_depth (lambda : R) : R :=
  2 * lambda ^ 2 / (lambda ^ 2 + 4000000).
Definition exact_radiance (lambda : R) : R :=
  2 - (2 - 2 * lambda ^ 2 / (lambda ^ 2 + 4000000)) * exp (-2 * lambda ^ 2 / (lambda ^ 2 + 4000000)).

Theorem kilometres_sloping (D : R) :
  0 <= D <= 10000 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End sloping.

Module curved.

Definition field (lambda : R) : R :=
  lambda.
Definition extinction (s : R) : R :=
  16000000 * s / (16000000000000 + 8000000 * s ^ 2 + s ^ 4).
Definition emission (s : R) : R :=
  1 + (2 * s ^ 2 / (s ^ 2 + 4000000) - 1) ^ 2.
Definition exact_depth (lambda : R) : R :=
  2 * lambda ^ 2 / (lambda ^ 2 + 4000000).
Definition exact_radiance (lambda : R) : R :=
  2 - (2 + (2 * lambda ^ 2 / (lambda ^ 2 + 4000000)) ^ 2) * exp (-2 * lambda ^ 2 / (lambda ^ 2 + 4000000)).

Theorem kilometres_curved (D : R) :
  0 <= D <= 10000 ->
  is_RInt (extinction_along field extinction) 0 D (exact_depth D) /\
  is_RInt (integrand field extinction emission) 0 D (exact_radiance D).
Proof. prove_case. Qed.
End curved.
